#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "docent/base/result.h"
#include "docent/simulator/pedestrians/track.h"

namespace docent::simulator {

/// Reads what a camera over a crowd recorded, in its own frame. Known by their looks:
///  - obsmat (ETH, zara): 8 columns, of which 1, 2, 3, 5 are frame, person, x, y [m];
///  - 4 columns: frame, person, x, y [m] (UCY students);
///  - Edinburgh: `TRACK.Rn=[[x y frame];[…]]`, pixels of 24.7 mm with y down, 9 frames a second.
/// A tracked person appears every few frames: that step, the commonest one, is kTrackStep, whatever the frames count.
/// Gaps of up to 2 s are bridged by a straight line, a longer one ends a track; who was seen once is no track.
/// Faults name file and line: a word that is no number, another number of columns, a person who is in two places at one
/// time or far off, tracks that nobody walks (not metres).
[[nodiscard]] Result<Recording> parse_recording(std::string_view text, const std::string& name);

/// The recording of a file, or of a folder: its obsmat.txt, or else the only .txt in it. Named after the folder.
[[nodiscard]] Result<Recording> load_recording(const std::filesystem::path& file_or_folder);

}  // namespace docent::simulator
