#pragma once

// Docent's own messages, package docent_msgs, by subject. A source that needs few of them includes those alone.
// Messages grow, at the end; a recording is read by the schema that it embeds (architecture 10.16).

#include "docent/messages/calibration_messages.h"
#include "docent/messages/driving_messages.h"
#include "docent/messages/interaction_messages.h"
#include "docent/messages/localization_messages.h"
#include "docent/messages/mission_messages.h"
#include "docent/messages/office_messages.h"
#include "docent/messages/operation_messages.h"
#include "docent/messages/people_messages.h"
#include "docent/messages/request_messages.h"
#include "docent/messages/sensing_messages.h"
#include "docent/messages/truth_messages.h"
