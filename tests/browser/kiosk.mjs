// What the tests of the robot's own screen share.
import { pause } from './harness.mjs';

export const shows = (page, name, patience = 8000) => page.locator(`main[data-screen=${name}]`).waitFor({ timeout: patience });
export const screenOf = (page) => page.locator('main').getAttribute('data-screen');
/** A press too soon after another is none: people need a moment, too. */
export const MOMENT = 400;
export const pressKey = async (page, key) => (await pause(MOMENT), await page.keyboard.press(key));
export const tap = async (page, selector) => (await pause(MOMENT), await page.locator(selector).tap());
export const lit = (page) => page.locator('main').getAttribute('data-lit');
