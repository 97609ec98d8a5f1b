#include <algorithm>

#include "docent/localization/markov/position_belief.h"

namespace docent {

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

/// Columns of a line that targets in the lines about it will ask for.
void PositionBelief::mark_needed(int row, int reach, std::span<const std::size_t> target_begin) {
  std::fill(needed_.begin(), needed_.end(), std::uint8_t{0});
  const auto first = static_cast<std::size_t>(std::max(row - reach, 0));
  const auto last = static_cast<std::size_t>(std::min(row + reach + 1, space_->frame().rows));
  for (std::size_t i = target_begin[first]; i < target_begin[last]; ++i)
    needed_[static_cast<std::size_t>(space_->cell(static_cast<std::size_t>(targets_[i])).column)] = 1;
}

void PositionBelief::mix_line(int row, const MotionKernel& kernel, std::span<const std::size_t> target_begin) {
  mark_needed(row, kernel.rows.reach, target_begin);
  const int columns = space_->frame().columns;
  const int reach = kernel.columns.reach;
  const auto headings = static_cast<std::size_t>(space_->headings());
  for (int first = 0; first < columns;) {
    if (needed_[static_cast<std::size_t>(first)] == 0) {
      ++first;
      continue;
    }
    int last = first;
    while (last < columns && needed_[static_cast<std::size_t>(last)] != 0) ++last;
    const auto count = static_cast<std::size_t>(last - first);
    expanded_.resize((count + 2 * static_cast<std::size_t>(reach)) * stride_);
    float* out = expanded_.data();
    for (int column = first - reach; column < last + reach; ++column, out += stride_) {
      const std::int32_t place = space_->place_at({column, row});
      const std::int32_t slot = place == StateSpace::kNoPlace ? -1 : slot_[static_cast<std::size_t>(place)];
      if (slot >= 0) {
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

void PositionBelief::move_row(std::size_t target, const MotionKernel& kernel, float* out, RowTotals& totals) {
  const auto headings = static_cast<std::size_t>(space_->headings());
  const CellIndex cell = space_->cell(target);
  for (int i = 0; i <= 2 * kernel.rows.reach; ++i) {
    const int row = cell.row - kernel.rows.reach + i;
    around_[static_cast<std::size_t>(i)] = row < 0 || row >= space_->frame().rows
                                               ? nothing_.data()
                                               : mixed_line(row) + static_cast<std::size_t>(cell.column) * stride_;
  }
  kernels_->mix_rows(kernel.rows, around_.data(), stride_ / kRowBlock, shifted_.data());
  // extended_[i] is the heading i - reach, so that the blur needs no modulo.
  const std::size_t reach = kernel.heading_weights.size() / 2;
  if (reach <= headings) {
    std::copy_n(shifted_.data() + headings - reach, reach, extended_.data());
    std::copy_n(shifted_.data(), headings, extended_.data() + reach);
    std::copy_n(shifted_.data(), reach, extended_.data() + reach + headings);
  } else {
    std::size_t from = headings - reach % headings;
    for (std::size_t i = 0; i < headings + 2 * reach; ++i, ++from) extended_[i] = shifted_[from % headings];
  }
  kernels_->turn(extended_.data(), kernel.heading_weights, headings, out, totals);
}

void PositionBelief::move(const MotionKernel& kernel) {
  const int rows = space_->frame().rows;
  const int reach = kernel.rows.reach;
  find_targets(kernel.reach());
  std::vector<std::size_t> target_begin(static_cast<std::size_t>(rows) + 1, 0);
  for (const std::int32_t place : targets_)
    ++target_begin[static_cast<std::size_t>(space_->cell(static_cast<std::size_t>(place)).row) + 1];
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) target_begin[row + 1] += target_begin[row];

  const auto columns = static_cast<std::size_t>(space_->frame().columns);
  needed_.resize(columns);
  ring_ = 2 * static_cast<std::size_t>(reach) + 1;
  line_ = columns * stride_;
  mixed_.resize(ring_ * line_);
  around_.resize(ring_);
  shifted_.resize(stride_);
  extended_.assign(stride_ + 2 * (kernel.heading_weights.size() / 2) + kRowBlock, 0.0F);
  rows_.resize(targets_.size() * stride_);

  RowTotals totals;
  int mixed_from = rows;  // lines from here on are in the ring, as far as they are still needed
  for (int row = rows - 1; row >= 0; --row) {
    const std::size_t begin = target_begin[static_cast<std::size_t>(row)];
    const std::size_t end = target_begin[static_cast<std::size_t>(row) + 1];
    if (begin == end) continue;
    for (int line = std::min({row + reach, mixed_from - 1, rows - 1}); line >= std::max(row - reach, 0); --line)
      mix_line(line, kernel, target_begin);
    mixed_from = std::max(row - reach, 0);
    for (std::size_t i = begin; i < end; ++i) {
      // A row is long enough for its lines of the cache to be late: ask for the next but one.
      const float* const ahead = rows_.data() + std::min(i + 2, end - 1) * stride_;
      for (std::size_t h = 0; h < stride_; h += kRowBlock) __builtin_prefetch(ahead + h, 1);
      move_row(static_cast<std::size_t>(targets_[i]), kernel, rows_.data() + i * stride_, totals);
    }
  }
  for (const std::int32_t place : kept_) slot_[static_cast<std::size_t>(place)] = -1;
  kept_.swap(targets_);
  for (std::size_t i = 0; i < kept_.size(); ++i)
    slot_[static_cast<std::size_t>(kept_[i])] = static_cast<std::int32_t>(i);
  set_scale(1.0, 0.0);
  normalise(totals, 0.0);
}

}  // namespace docent
