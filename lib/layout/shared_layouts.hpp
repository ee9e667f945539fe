#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "layout/incremental_layout.hpp"

namespace cairn {

/// Where places lie, and how well the travels agree with it: see PlaceLayout.
struct LaidPlaces {
  std::vector<Pose2> T_global_place;
  double chi2 = 0.0;
};

/// Lays out maps that have most of their travels in common, as the hypotheses of one experience do.
/// Layouts are kept; one that is asked for goes on from the kept one with which it shares the most
/// travels, counted from the first, and pays for the others only.
///
/// What is kept is bounded: the layouts not used for longest are given up, and made anew if they
/// are asked for again. The answer does not depend on what is kept, bit for bit: a layout that grew
/// travel by travel is the same whoever made its beginning.
///
/// Source: Modayil, Beeson and Kuipers, IROS 2004, Sec. IV-D, for each map of the tree of maps of
/// Kuipers et al., ICRA 2004, Sec. III-D.
class SharedLayouts {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;

  /// @pre validate(options).ok()
  explicit SharedLayouts(const LayoutOptions& options, std::size_t max_bytes = kMaxBytes)
      : options_(options), max_bytes_(max_bytes) {}

  /// What solve_layout() says of these travels, to about 1e-6 of chi2. Travels that do not come to
  /// the places in the order of their numbers, and options with a loss for outliers, are solved at
  /// once and not kept. Errors as those of solve_layout().
  [[nodiscard]] Result<LaidPlaces> lay_out(int place_count,
                                           const std::vector<TravelConstraint>& travels);

  /// Travels added to layouts so far: what was not shared.
  [[nodiscard]] std::int64_t added_count() const { return added_count_; }
  /// Maps that were solved at once.
  [[nodiscard]] std::int64_t solved_count() const { return solved_count_; }
  [[nodiscard]] std::size_t kept_count() const { return kept_.size(); }

 private:
  struct Kept {
    IncrementalLayout layout;
    std::size_t bytes = 0;
    std::int64_t used = 0;  ///< Greater is later.
  };

  [[nodiscard]] Result<LaidPlaces> solved(int place_count,
                                          const std::vector<TravelConstraint>& travels);
  [[nodiscard]] IncrementalLayout longest_beginning(const std::vector<TravelConstraint>& travels,
                                                    const std::vector<std::uint64_t>& keys);
  void keep(std::uint64_t key, IncrementalLayout layout);

  LayoutOptions options_;
  std::size_t max_bytes_;
  std::size_t bytes_ = 0;
  std::int64_t uses_ = 0;
  std::int64_t added_count_ = 0;
  std::int64_t solved_count_ = 0;
  std::map<std::uint64_t, Kept> kept_;  ///< By the key of all its travels.
};

}  // namespace cairn
