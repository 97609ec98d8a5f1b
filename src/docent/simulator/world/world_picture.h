#pragma once

#include "docent/pictures/map_picture.h"
#include "docent/simulator/world/survey.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// The true museum as a plan: floor, operating area, solids by kind with their names where there is room, attractions,
/// entrances and home.
void draw_world(pictures::Axes& axes, const World& world);
void draw_operating_area(pictures::Axes& axes, const World& world);
void add_world_legend(pictures::Figure& figure, const World& world);
/// All of it.
[[nodiscard]] pictures::Figure draw_world(const World& world);

/// What the robot is told of it: map and hazards.
void draw_survey(pictures::Axes& axes, const Survey& survey);
void add_survey_legend(pictures::Figure& figure, const Survey& survey);
[[nodiscard]] pictures::Figure draw_survey(const Survey& survey);

}  // namespace docent::simulator
