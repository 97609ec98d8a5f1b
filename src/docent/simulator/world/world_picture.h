#pragma once

#include "docent/pictures/map_picture.h"
#include "docent/simulator/world/survey.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// The true museum as a plan: floor, operating area, solids by kind with their names where there is room, attractions,
/// entrances and home.
void draw_world(Axes& axes, const World& world);
void draw_operating_area(Axes& axes, const World& world);
void add_world_legend(Figure& figure, const World& world);
/// All of it.
[[nodiscard]] Figure draw_world(const World& world);

/// What the robot is told of it: map and hazards.
void draw_survey(Axes& axes, const Survey& survey);
void add_survey_legend(Figure& figure, const Survey& survey);
[[nodiscard]] Figure draw_survey(const Survey& survey);

}  // namespace docent::simulator
