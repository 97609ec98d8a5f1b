#pragma once

#include "docent/base/result.h"
#include "docent/task_control/golex/approach_watch.h"
#include "docent/task_control/golex/docking.h"
#include "docent/task_control/reaction_ladder/reaction_ladder.h"

namespace docent::task_control {

/// Section `executive` of robot.yaml.
struct ExecutiveParams {
  LadderParams ladder;              ///< what it does about a blocked way, and when
  ApproachParams approach;          ///< when a drive that moves is in vain
  DockingParams docking;            ///< from standing at the charger to charging
  double max_drive_s = 600.0;       ///< [s] > 0 under way in all
  double charger_tolerance = 0.15;  ///< [m] > 0: contacts lie closer than where an exhibit is shown
  double no_drive_s = 5.0;          ///< [s] >= 0: a shorter drive led nowhere: it stood there before
  double offer_s = 5.0;             ///< [s] > 0 to choose more or next ([Rhino1999] 5.1 (3))
  double resend_s = 1.0;            ///< [s] > 0: an utterance is sent again until it is heard
  double checkpoint_age_s = 900.0;  ///< [s] > 0: an older running step begins again
  template <class V>
  void visit(V& v) {
    v("ladder", ladder);
    v("approach", approach);
    v("docking", docking);
    v("max_drive_s", max_drive_s);
    v("charger_tolerance", charger_tolerance);
    v("no_drive_s", no_drive_s);
    v("offer_s", offer_s);
    v("resend_s", resend_s);
    v("checkpoint_age_s", checkpoint_age_s);
  }
  [[nodiscard]] Result<void> validate() const;
};

}  // namespace docent::task_control
