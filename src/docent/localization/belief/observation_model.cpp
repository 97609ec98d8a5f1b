#include "docent/localization/belief/observation_model.h"

namespace docent::localization {

bool ObservationModels::observe(const ObservationMoment& moment) {
  speaking_.clear();
  for (const auto& model : models_)
    if (model->observe(moment)) speaking_.push_back(model.get());
  return !speaking_.empty();
}

void ObservationModels::add_costs(std::span<const Pose2> map_from_robot, std::span<float> nats) const {
  for (const ObservationModel* model : speaking_) model->add_costs(map_from_robot, nats);
}

double ObservationModels::mean_cost() const {
  double sum = 0.0;
  for (const ObservationModel* model : speaking_) sum += model->mean_cost();
  return sum;
}

double ObservationModels::cost(const Pose2& map_from_robot) const {
  float nats = 0.0F;
  add_costs({&map_from_robot, 1}, {&nats, 1});
  return static_cast<double>(nats);
}

}  // namespace docent::localization
