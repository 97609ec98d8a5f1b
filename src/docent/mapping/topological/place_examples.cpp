#include <array>

#include "docent/mapping/topological/place_kind.h"

namespace docent::mapping {
namespace {

/// `scripts/evaluate rooms --part examples` prints these.
constexpr auto kExamples = std::to_array<PlaceExample>({
    {{42.8, 4.12, 2.52, 1}, PlaceKind::room},      {{27.9, 3.56, 2.20, 1}, PlaceKind::room},
    {{29.5, 2.98, 3.33, 1}, PlaceKind::room},      {{24.8, 3.28, 2.30, 1}, PlaceKind::room},
    {{22.3, 2.63, 3.23, 1}, PlaceKind::room},      {{20.8, 2.77, 2.72, 1}, PlaceKind::room},
    {{18.8, 2.44, 3.17, 1}, PlaceKind::room},      {{20.4, 2.52, 3.21, 2}, PlaceKind::room},
    {{19.2, 2.78, 2.49, 1}, PlaceKind::room},      {{22.1, 2.59, 3.31, 1}, PlaceKind::room},
    {{91.5, 2.51, 14.47, 14}, PlaceKind::hallway}, {{15.5, 2.12, 3.43, 1}, PlaceKind::room},
    {{14.0, 2.07, 3.28, 1}, PlaceKind::room},      {{14.1, 2.31, 2.64, 1}, PlaceKind::room},
    {{28.5, 3.63, 2.16, 1}, PlaceKind::room},      {{27.1, 3.28, 2.52, 1}, PlaceKind::room},
    {{26.8, 3.20, 2.61, 1}, PlaceKind::room},      {{23.9, 3.10, 2.49, 0}, PlaceKind::room},
    {{23.4, 3.02, 2.57, 1}, PlaceKind::room},      {{24.3, 2.84, 3.02, 1}, PlaceKind::room},
    {{28.1, 3.19, 2.77, 1}, PlaceKind::room},      {{26.9, 3.19, 2.64, 1}, PlaceKind::room},
    {{17.5, 2.51, 2.79, 1}, PlaceKind::room},      {{13.8, 2.56, 2.12, 0}, PlaceKind::room},
    {{19.4, 2.41, 3.33, 1}, PlaceKind::room},      {{17.0, 2.75, 2.25, 1}, PlaceKind::room},
    {{12.9, 2.49, 2.09, 1}, PlaceKind::room},      {{35.0, 2.26, 6.86, 4}, PlaceKind::hallway},
    {{13.9, 2.22, 2.82, 1}, PlaceKind::room},      {{11.0, 2.10, 2.49, 1}, PlaceKind::room},
    {{42.9, 2.33, 7.88, 8}, PlaceKind::hallway},   {{9.0, 2.12, 2.00, 3}, PlaceKind::hallway},
    {{9.1, 2.06, 2.13, 4}, PlaceKind::room},       {{33.6, 3.95, 2.15, 1}, PlaceKind::room},
    {{30.3, 3.78, 2.13, 1}, PlaceKind::room},      {{28.6, 3.48, 2.36, 1}, PlaceKind::room},
    {{20.7, 3.02, 2.27, 1}, PlaceKind::room},      {{20.3, 2.88, 2.44, 0}, PlaceKind::room},
    {{23.3, 3.08, 2.45, 1}, PlaceKind::room},      {{27.0, 3.00, 3.00, 1}, PlaceKind::room},
    {{16.8, 2.39, 2.94, 1}, PlaceKind::room},      {{72.4, 2.43, 12.22, 9}, PlaceKind::hallway},
    {{12.4, 2.31, 2.31, 1}, PlaceKind::room},      {{11.1, 2.08, 2.56, 1}, PlaceKind::room},
    {{35.7, 3.85, 2.41, 0}, PlaceKind::room},      {{28.0, 3.39, 2.43, 0}, PlaceKind::room},
    {{28.2, 3.16, 2.81, 1}, PlaceKind::room},      {{27.8, 3.09, 2.90, 1}, PlaceKind::room},
    {{24.2, 2.89, 2.89, 1}, PlaceKind::room},      {{23.7, 2.75, 3.13, 1}, PlaceKind::room},
    {{24.1, 2.68, 3.37, 0}, PlaceKind::room},      {{18.9, 2.41, 3.25, 1}, PlaceKind::room},
    {{16.9, 2.22, 3.41, 1}, PlaceKind::room},      {{170.0, 2.49, 27.40, 10}, PlaceKind::hallway},
    {{14.7, 2.29, 2.80, 1}, PlaceKind::room},      {{16.0, 2.20, 3.29, 0}, PlaceKind::room},
    {{13.5, 2.12, 3.01, 1}, PlaceKind::room},      {{11.4, 1.97, 2.94, 1}, PlaceKind::room},
    {{12.4, 1.82, 3.72, 0}, PlaceKind::room},      {{12.9, 1.76, 4.14, 1}, PlaceKind::room},
    {{32.7, 3.21, 3.17, 1}, PlaceKind::room},      {{22.8, 3.00, 2.54, 1}, PlaceKind::room},
    {{20.9, 2.83, 2.60, 1}, PlaceKind::room},      {{21.0, 2.75, 2.78, 1}, PlaceKind::room},
    {{17.3, 2.47, 2.85, 1}, PlaceKind::room},      {{14.5, 2.19, 3.03, 1}, PlaceKind::room},
    {{12.4, 1.98, 3.15, 1}, PlaceKind::room},      {{10.6, 2.19, 2.22, 1}, PlaceKind::room},
    {{14.9, 2.05, 3.55, 1}, PlaceKind::room},      {{61.1, 2.09, 13.93, 10}, PlaceKind::hallway},
    {{12.4, 1.58, 4.99, 1}, PlaceKind::room},      {{20.3, 3.08, 2.13, 1}, PlaceKind::room},
    {{24.6, 3.00, 2.74, 1}, PlaceKind::room},      {{20.6, 2.86, 2.52, 1}, PlaceKind::room},
    {{26.3, 2.98, 2.96, 1}, PlaceKind::room},      {{20.9, 2.58, 3.15, 1}, PlaceKind::room},
    {{20.4, 2.73, 2.74, 0}, PlaceKind::room},      {{20.7, 2.85, 2.55, 1}, PlaceKind::room},
    {{65.5, 2.32, 12.14, 7}, PlaceKind::hallway},  {{16.4, 2.23, 3.31, 1}, PlaceKind::room},
    {{14.6, 2.29, 2.77, 1}, PlaceKind::room},      {{10.6, 2.12, 2.36, 0}, PlaceKind::room},
    {{13.7, 2.03, 3.33, 1}, PlaceKind::room},      {{14.1, 2.26, 2.76, 1}, PlaceKind::room},
    {{11.6, 2.13, 2.56, 1}, PlaceKind::room},      {{10.0, 1.99, 2.52, 1}, PlaceKind::room},
    {{12.6, 2.01, 3.11, 1}, PlaceKind::room},      {{23.0, 2.03, 5.59, 3}, PlaceKind::hallway},
    {{7.3, 2.07, 1.71, 3}, PlaceKind::room},       {{43.9, 2.06, 10.33, 8}, PlaceKind::hallway},
    {{46.6, 4.33, 2.48, 1}, PlaceKind::room},      {{34.8, 3.96, 2.22, 1}, PlaceKind::room},
    {{32.4, 3.31, 2.95, 1}, PlaceKind::room},      {{24.8, 3.19, 2.44, 1}, PlaceKind::room},
    {{26.5, 3.24, 2.52, 1}, PlaceKind::room},      {{27.7, 3.18, 2.74, 1}, PlaceKind::room},
    {{26.3, 2.78, 3.40, 1}, PlaceKind::room},      {{24.0, 2.69, 3.32, 1}, PlaceKind::room},
    {{20.1, 2.55, 3.10, 1}, PlaceKind::room},      {{20.1, 2.61, 2.96, 2}, PlaceKind::room},
    {{17.3, 2.42, 2.96, 0}, PlaceKind::room},      {{193.7, 2.42, 33.10, 18}, PlaceKind::hallway},
    {{18.1, 2.21, 3.71, 1}, PlaceKind::room},      {{16.8, 2.15, 3.66, 1}, PlaceKind::room},
    {{13.4, 2.37, 2.39, 1}, PlaceKind::room},      {{13.0, 1.99, 3.27, 0}, PlaceKind::room},
    {{14.3, 2.04, 3.43, 1}, PlaceKind::room},      {{13.6, 2.20, 2.81, 1}, PlaceKind::room},
    {{8.8, 1.74, 2.90, 1}, PlaceKind::room},       {{8.1, 1.70, 2.81, 1}, PlaceKind::room},
    {{33.5, 3.57, 2.63, 1}, PlaceKind::room},      {{21.1, 2.93, 2.46, 1}, PlaceKind::room},
    {{19.9, 2.90, 2.36, 1}, PlaceKind::room},      {{18.1, 2.77, 2.37, 0}, PlaceKind::room},
    {{18.8, 2.53, 2.93, 1}, PlaceKind::room},      {{18.8, 2.70, 2.58, 1}, PlaceKind::room},
    {{16.0, 2.55, 2.46, 1}, PlaceKind::room},      {{18.3, 2.61, 2.69, 1}, PlaceKind::room},
    {{14.8, 2.28, 2.85, 1}, PlaceKind::room},      {{85.0, 2.55, 13.07, 11}, PlaceKind::hallway},
    {{15.1, 2.22, 3.05, 1}, PlaceKind::room},      {{11.1, 2.15, 2.38, 1}, PlaceKind::room},
    {{14.6, 2.00, 3.66, 1}, PlaceKind::room},
});

}  // namespace

std::span<const PlaceExample> place_examples() { return kExamples; }

}  // namespace docent::mapping
