#include "docent/task_control/golex/docking.h"

#include <array>
#include <span>

namespace docent::task_control {

/// A wait, or a drive to a place on the charger's axis.
struct Docking::Step {
  enum class Kind {
    contact,  ///< waits for the battery to charge
    room,     ///< waits for what stands on the charger to go
    aside,    ///< a drive to where it sets out anew
    closer,   ///< a drive to the charger
    beside,   ///< a drive as near to it as there is room
    tag,      ///< a drive by the charger's tag
    before    ///< a drive to where the tag is seen
  };
  Kind kind;
  const char* move;  ///< nullptr: it waits
  double side;       ///< of the stand-off: 1 before the charger, -1 behind it, 0 at it
};

namespace {

constexpr Duration kFreeFor = std::chrono::seconds{2};  // then what stood on the charger is gone

}  // namespace

std::span<const Docking::Step> Docking::steps() const {
  using enum Step::Kind;
  static constexpr std::array kFree{
      Step{contact, nullptr, 0.0}, Step{closer, "closer", 0.0},      Step{contact, nullptr, 0.0},
      Step{aside, "before", 1.0},  Step{closer, "from-before", 0.0}, Step{contact, nullptr, 0.0},
      Step{aside, "behind", -1.0}, Step{closer, "from-behind", 0.0}, Step{contact, nullptr, 0.0},
  };
  static constexpr std::array kOccupied{
      Step{room, nullptr, 0.0},         Step{closer, "again", 0.0},  Step{contact, nullptr, 0.0},
      Step{beside, "beside", 0.0},      Step{contact, nullptr, 0.0}, Step{aside, "behind", -1.0},
      Step{closer, "from-behind", 0.0}, Step{contact, nullptr, 0.0},
  };
  static constexpr std::array kTag{
      Step{before, "before-tag", 0.0},  Step{tag, nullptr, 0.0},     Step{contact, nullptr, 0.0},
      Step{before, "again", 0.0},       Step{tag, nullptr, 0.0},     Step{contact, nullptr, 0.0},
      Step{closer, "closer", 0.0},      Step{contact, nullptr, 0.0}, Step{aside, "before", -1.0},
      Step{closer, "from-before", 0.0}, Step{contact, nullptr, 0.0},
  };
  switch (start_) {
    case DockingStart::occupied:
      return kOccupied;
    case DockingStart::before_tag:
      return std::span{kTag}.subspan(1);
    case DockingStart::at_charger_tag:
      return kTag;
    case DockingStart::at_charger:
      break;
  }
  return kFree;
}

const Docking::Step* Docking::now_at() const {
  const std::span<const Step> all = steps();
  return step_ < all.size() ? &all[step_] : nullptr;
}

bool Docking::is_by_tag() const {
  const Step* step = now_at();
  if (step == nullptr) return false;
  return step->kind == Step::Kind::tag || (step_ > 0 && steps()[step_ - 1].kind == Step::Kind::tag);
}

Result<void> DockingParams::validate() const {
  if (!(contact_s > 0.0)) return fail("docking.contact_s must be > 0");
  if (!(move_s > 0.0)) return fail("docking.move_s must be > 0");
  if (!(stand_off_m > 0.0)) return fail("docking.stand_off_m must be > 0");
  if (!(closer_tolerance > 0.0)) return fail("docking.closer_tolerance must be > 0");
  if (!(occupied_near_m > 0.0)) return fail("docking.occupied_near_m must be > 0");
  if (!(occupied_after_s > 0.0)) return fail("docking.occupied_after_s must be > 0");
  if (!(occupied_wait_s > 0.0)) return fail("docking.occupied_wait_s must be > 0");
  if (!(blocked_s > 0.0)) return fail("docking.blocked_s must be > 0");
  if (!(tag_stand_off_m > 0.0)) return fail("docking.tag_stand_off_m must be > 0");
  if (!(tag_answer_s > 0.0)) return fail("docking.tag_answer_s must be > 0");
  if (!(beside_tolerance > 0.0)) return fail("docking.beside_tolerance must be > 0");
  return {};
}

Docking::Docking(const DockingParams& params, Pose2 map_from_charger, DockingStart start, Time now)
    : params_{params},
      map_from_charger_{map_from_charger},
      since_{now},
      start_{start},
      is_occupied_{start == DockingStart::occupied},
      stands_there_{start == DockingStart::at_charger},
      stood_there_{start == DockingStart::at_charger},
      last_occupied_{now} {}

std::optional<std::string> Docking::tag_order() const {
  const Step* step = now_at();
  if (step == nullptr || step->kind != Step::Kind::tag) return std::nullopt;
  return "by-tag-" + std::to_string(step_);
}

std::optional<Docking::Move> Docking::move() const {
  const Step* step = now_at();
  if (step == nullptr || step->move == nullptr) return std::nullopt;
  if (step->kind == Step::Kind::before)
    return Move{step->move, map_from_charger_ * Pose2{-params_.tag_stand_off_m, 0.0, {}}, BeforeTag::kPosition,
                BeforeTag::kHeading};
  // Who docks by itself looks at the dock from the museum's charger: it sets out anew from farther off.
  const double side = params_.by_action ? -step->side : step->side;
  const Pose2 charger_from_base{side * params_.stand_off_m, 0.0, {}};
  const bool is_beside = step->kind == Step::Kind::beside;
  return Move{step->move, map_from_charger_ * charger_from_base,
              is_beside ? params_.beside_tolerance : params_.closer_tolerance};
}

void Docking::note(const Step& step, const DockingView& view) {
  if (step.kind == Step::Kind::tag) {
    stands_there_ = view.by_tag == ByTag::arrived;
    stood_there_ = stood_there_ || stands_there_;
  }
  if (step.kind == Step::Kind::before) stands_there_ = false;
  if (step.kind != Step::Kind::closer && step.kind != Step::Kind::beside) return;
  // So near to a place on which something stands a drive counts as arrived, but the robot is not there.
  stands_there_ = view.moved == GoalStatus::arrived && !view.is_occupied;
  stood_there_ = stood_there_ || stands_there_;
  if (view.is_occupied && !stands_there_) is_occupied_ = true;
  if (stands_there_) is_occupied_ = false;
}

bool Docking::is_over(const Step& step, const DockingView& view, Time now) const {
  const Duration lasted = now - since_;
  switch (step.kind) {
    case Step::Kind::contact:  // where it does not stand, nothing will come
      return !stands_there_ || lasted >= seconds(params_.contact_s);
    case Step::Kind::room:
      return now - last_occupied_ >= kFreeFor || lasted >= seconds(params_.occupied_wait_s);
    case Step::Kind::tag:
      return view.by_tag == ByTag::none || view.by_tag == ByTag::failed || view.by_tag == ByTag::arrived ||
             (view.by_tag == ByTag::ready && lasted >= seconds(params_.tag_answer_s));
    case Step::Kind::aside:
    case Step::Kind::closer:
    case Step::Kind::beside:
    case Step::Kind::before:
      break;
  }
  const bool is_in_vain = view.moved == GoalStatus::unreachable ||
                          (view.moved == GoalStatus::blocked && view.blocked_s >= params_.blocked_s);
  return view.moved == GoalStatus::arrived || is_in_vain || lasted >= seconds(params_.move_s);
}

Docking::State Docking::step(const DockingView& view, Time now) {
  const Step* step = now_at();
  if (step == nullptr) return State::failed;
  if (view.is_occupied) last_occupied_ = now;
  const bool is_waiting = step->move == nullptr;
  if (is_waiting && view.contact == Contact::made) return State::docked;
  if (is_waiting && view.contact == Contact::coming) {
    since_ = now;
    return State::under_way;
  }
  if (step->kind == Step::Kind::contact && stands_there_ && view.contact == Contact::unknown) return State::docked;
  if (!is_over(*step, view, now)) return State::under_way;
  if (step->kind == Step::Kind::contact && stands_there_ && view.contact == Contact::unheard)
    return State::docked;  // a robot without a gauge
  note(*step, view);
  ++step_;
  since_ = now;
  const bool is_tag_over = step->kind == Step::Kind::tag;
  return now_at() == nullptr                    ? State::failed
         : move() || tag_order() || is_tag_over ? State::sets_out
                                                : State::under_way;
}

ReasonWord Docking::failure() const {
  if (is_occupied_) return ReasonWord::charger_occupied;
  return stood_there_ ? ReasonWord::charger_no_current : ReasonWord::not_reached;
}

}  // namespace docent::task_control
