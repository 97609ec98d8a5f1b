#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/museum/editing/museum_draft.h"
#include "docent/museum/editing/museum_text.h"

namespace docent::museum {

/// Where a robot that keeps its state in `state` has the trial of a museum.
[[nodiscard]] inline std::filesystem::path trial_folder(const std::filesystem::path& state) { return state / "trial"; }

/// "/a/folder/museum.yaml:12: home lies …" without the file, which people on the page do not see.
[[nodiscard]] std::vector<std::string> sentences_of(const std::vector<Error>& faults);

/// Where a museum is changed: people work on a draft of it, have it checked, let the robot try it, and publish it into
/// the museum's folder. A trial is a folder beside it, in which the robot finds the museum as the draft has it; all
/// that the draft leaves alone are links. Not thread-safe.
class MuseumWorkshop {
 public:
  /// @param folder  of the museum in which the robot is now: the published one, or the trial
  /// @param trial   where a trial is laid out; made when there is one, replaced by the next
  /// @param stage   of the museum: one that is being set up may be published without an exhibit
  MuseumWorkshop(std::filesystem::path folder, std::filesystem::path trial, const CheckedRobot& robot,
                 Stage stage = Stage::complete);

  /// The robot finds its way in a trial.
  [[nodiscard]] bool is_trial() const { return is_trial_; }
  /// The museum's own folder.
  [[nodiscard]] const std::filesystem::path& published() const { return published_; }

  struct Edition {
    Museum museum;         ///< in which the robot is now, without its map
    std::string revision;  ///< of what is published, texts too: another one when anybody has changed it since
  };
  [[nodiscard]] Result<Edition> read() const;

  /// Everything that cannot work in the museum of the draft, each as a sentence; empty: it may be tried. O(cells).
  /// Error: it could not be looked at.
  [[nodiscard]] Result<std::vector<std::string>> check(const MuseumDraft& draft) const;

  /// What came of a wish to change the museum.
  struct Outcome {
    std::vector<std::string> faults;  ///< why nothing was done
    bool is_outdated = false;         ///< nothing was done, for `revision` is not that of what is published
  };
  [[nodiscard]] Result<Outcome> try_out(const MuseumDraft& draft, const std::string& revision) const;
  /// Writes into the museum's folder. What museum.yaml said before is kept as museum.yaml.before.
  [[nodiscard]] Result<Outcome> publish(const MuseumDraft& draft, const std::string& revision) const;
  /// Keeps a picture in the museum's folder, where an exhibit of a draft may name it from now on. Its name comes of its
  /// content. Where there are too many already, those that no museum.yaml names are removed.
  /// @param ending  ".jpg" @returns its name relative to the folder. Error: it cannot be written, or there are too many
  [[nodiscard]] Result<std::filesystem::path> keep_picture(const std::string& content, const std::string& ending) const;

 private:
  struct Published {
    std::string yaml, revision;
  };
  [[nodiscard]] Result<Published> read_published() const;
  [[nodiscard]] Result<EditedMuseum> edit(const std::string& yaml, const MuseumDraft& draft) const;
  /// The museum with those files, in `where`.
  [[nodiscard]] Result<void> lay_out(const std::filesystem::path& where, const FolderFiles& files) const;
  /// The faults of the museum laid out in `where`.
  [[nodiscard]] Result<std::vector<std::string>> check(const std::filesystem::path& where,
                                                       const MuseumDraft& draft) const;

  std::filesystem::path folder_, trial_, published_;
  bool is_trial_ = false;
  CheckedRobot robot_;
  Stage stage_;
};

}  // namespace docent::museum
