#include <algorithm>
#include <array>

#include "docent/localization/markov/position_belief.h"

namespace docent::localization {

namespace {

/// Room for the blur before the headings and behind, in whole blocks.
std::size_t halo_of(const HeadingBlur& blur) { return (blur.reach() + kRowBlock - 1) / kRowBlock * kRowBlock; }

}  // namespace

/// The motion of a belief, in place. Lines of cells are taken from the last to the first: a line is mixed along x,
/// once, into a ring of as many lines as the motion reaches up and down, and what the ring holds about a line gives the
/// new rows of its places. The places that are kept only become more, so a new row never lies before the old one, and
/// what is overwritten has been read.

void PositionBelief::find_targets(int reach) {
  targets_.clear();
  if (kept_.size() == space_->places()) {
    targets_ = kept_;
    return;
  }
  for (const std::int32_t place : kept_) {
    const CellIndex cell = space_->cell(static_cast<std::size_t>(place));
    for (int row = cell.row - reach; row <= cell.row + reach; ++row) {
      for (int column = cell.column - reach; column <= cell.column + reach; ++column) {
        const std::int32_t near = space_->place_at({column, row});
        if (near == StateSpace::kNoPlace || marks_[static_cast<std::size_t>(near)] != 0) continue;
        marks_[static_cast<std::size_t>(near)] = 1;
        targets_.push_back(near);
      }
    }
  }
  std::sort(targets_.begin(), targets_.end());
  for (const std::int32_t place : targets_) marks_[static_cast<std::size_t>(place)] = 0;
}

/// Counts the targets of a line of cells in their columns, with sign.
void PositionBelief::count_targets(int row, int sign, std::span<const std::size_t> target_begin) {
  if (row < 0 || row >= space_->frame().rows) return;
  const auto line = static_cast<std::size_t>(row);
  for (std::size_t i = target_begin[line]; i < target_begin[line + 1]; ++i)
    asked_[static_cast<std::size_t>(space_->cell(static_cast<std::size_t>(targets_[i])).column)] += sign;
}

/// Of the columns that targets ask for.
void PositionBelief::mix_line(int row, const MotionKernel& kernel) {
  const int columns = space_->frame().columns;
  const int reach = kernel.columns.reach;
  const auto headings = static_cast<std::size_t>(space_->headings());
  for (int first = 0; first < columns;) {
    if (asked_[static_cast<std::size_t>(first)] == 0) {
      ++first;
      continue;
    }
    int last = first;
    while (last < columns && asked_[static_cast<std::size_t>(last)] != 0) ++last;
    const auto count = static_cast<std::size_t>(last - first);
    const std::size_t stretch = count + 2 * static_cast<std::size_t>(reach);
    expanded_.resize(std::max(expanded_.size(), stretch * stride_));
    float* out = expanded_.data();
    for (int column = first - reach; column < last + reach; ++column, out += stride_) {
      const std::int32_t place = space_->place_at({column, row});
      const std::int32_t slot = place == StateSpace::kNoPlace ? -1 : slot_[static_cast<std::size_t>(place)];
      if (slot >= 0) {
        prefetch_row(static_cast<std::size_t>(slot) + 10);
        kernels_->expand(rows_.data() + static_cast<std::size_t>(slot) * stride_, scale(), out);
        continue;
      }
      std::fill_n(out, stride_, 0.0F);
      if (place != StateSpace::kNoPlace) std::fill_n(out, headings, static_cast<float>(sea_));
    }
    kernels_->mix_columns(kernel.columns, expanded_.data(), count, stride_ / kRowBlock,
                          mixed_line(row) + static_cast<std::size_t>(first) * stride_);
    first = last;
  }
}

/// The lines of cells, mixed along x, that targets in kRowGroup lines from `low` on ask for.
void PositionBelief::find_lines(int low, int reach) {
  for (std::size_t i = 0; i < around_.size(); ++i) {
    const int row = low - reach + static_cast<int>(i);
    around_[i] = row < 0 || row >= space_->frame().rows ? nothing_.data() : mixed_line(row);
  }
}

/// The new rows of a column's targets among kRowGroup lines of cells; targets[r] is negative where there is none.
void PositionBelief::move_column(std::size_t column, const MotionKernel& kernel, std::span<const std::int32_t> targets,
                                 RowTotals& totals) {
  const std::size_t reach = kernel.headings.reach();
  const std::size_t halo = halo_of(kernel.headings);
  const std::size_t blocks = stride_ / kRowBlock;
  const std::size_t length = extended_.size() / kRowGroup;
  const auto headings = static_cast<std::size_t>(space_->headings());
  kernels_->mix_rows(kernel.rows, around_.data(), column * stride_, blocks, extended_.data() + halo, length);
  // Each step for all rows: what was just written is better not read at once, from where no store began.
  for (std::size_t r = 0; r < kRowGroup; ++r) {
    float* const centre = extended_.data() + r * length + halo;
    float* const end = centre + headings;  // the headings go round, so that the blur needs no modulo
    if (halo <= headings) {
      for (std::size_t i = 0; i < halo; i += kRowBlock) {
        std::copy_n(centre + i, kRowBlock, end + i);  // more than the reach, but of a length that is known
        std::copy_n(end - halo + i, kRowBlock, centre - halo + i);
      }
      continue;
    }
    for (std::size_t i = 0; i < reach; ++i) end[i] = centre[i];  // more than once round
    for (std::size_t i = 1; i <= reach; ++i) *(centre - i) = *(end - i);
  }
  if (!kernel.headings.fours.empty())
    for (std::size_t at = halo; at < extended_.size(); at += length)
      kernels_->add_fours(extended_.data() + at, halo, blocks, fours_.data() + at);
  for (std::size_t r = 0; r < kRowGroup; ++r) {
    if (targets[r] < 0) continue;
    const std::size_t at = r * length + halo;
    kernels_->turn(extended_.data() + at, kernel.headings, fours_.data() + at, headings,
                   rows_.data() + static_cast<std::size_t>(targets[r]) * stride_, totals);
  }
}

void PositionBelief::make_room(const MotionKernel& kernel) {
  const auto columns = static_cast<std::size_t>(space_->frame().columns);
  asked_.assign(columns, 0);
  ring_ = 2 * static_cast<std::size_t>(kernel.rows.reach) + kRowGroup;
  line_ = columns * stride_ + kRowBlock;  // lines that lie a power of two apart would share a set of the cache
  mixed_.resize(ring_ * line_);
  around_.resize(ring_);
  extended_.assign(kRowGroup * (stride_ + 2 * halo_of(kernel.headings) + kRowBlock), 0.0F);
  fours_.resize(extended_.size());
  nothing_.assign(line_, 0.0F);
}

void PositionBelief::move(const MotionKernel& kernel) {
  constexpr int kGroup = kRowGroup;
  const int rows = space_->frame().rows;
  const int reach = kernel.rows.reach;
  find_targets(kernel.reach());
  std::vector<std::size_t> target_begin(static_cast<std::size_t>(rows) + 1, 0);
  for (const std::int32_t place : targets_)
    ++target_begin[static_cast<std::size_t>(space_->cell(static_cast<std::size_t>(place)).row) + 1];
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) target_begin[row + 1] += target_begin[row];
  make_room(kernel);

  RowTotals totals;
  std::vector<std::array<std::int32_t, kRowGroup>> group(static_cast<std::size_t>(space_->frame().columns));
  int mixed_from = rows;              // lines from here on are in the ring, as far as they are still needed
  int counted_from = rows + reach;    // and the targets of lines from here
  int counted_before = counted_from;  // to here are counted
  for (int low = (rows - 1) / kGroup * kGroup; low >= 0; low -= kGroup) {
    const int end = std::min(low + kGroup, rows);
    if (target_begin[static_cast<std::size_t>(low)] == target_begin[static_cast<std::size_t>(end)]) continue;
    for (int line = std::min({end - 1 + reach, mixed_from - 1, rows - 1}); line >= std::max(low - reach, 0); --line) {
      while (counted_from > line - reach) count_targets(--counted_from, 1, target_begin);
      while (counted_before > line + reach + 1) count_targets(--counted_before, -1, target_begin);
      mix_line(line, kernel);
    }
    mixed_from = std::max(low - reach, 0);
    find_lines(low, reach);
    std::array<std::int32_t, kRowGroup> none;
    none.fill(-1);
    std::fill(group.begin(), group.end(), none);
    for (int row = low; row < end; ++row)
      for (std::size_t i = target_begin[static_cast<std::size_t>(row)];
           i < target_begin[static_cast<std::size_t>(row) + 1]; ++i)
        group[static_cast<std::size_t>(space_->cell(static_cast<std::size_t>(targets_[i])).column)]
             [static_cast<std::size_t>(row - low)] = static_cast<std::int32_t>(i);
    for (std::size_t column = 0; column < group.size(); ++column) {
      if (group[column] == none) continue;
      move_column(column, kernel, group[column], totals);
    }
  }
  for (const std::int32_t place : kept_) slot_[static_cast<std::size_t>(place)] = -1;
  kept_.swap(targets_);
  for (std::size_t i = 0; i < kept_.size(); ++i)
    slot_[static_cast<std::size_t>(kept_[i])] = static_cast<std::int32_t>(i);
  set_scale(1.0, 0.0);
  normalise(totals, 0.0);
}

}  // namespace docent::localization
