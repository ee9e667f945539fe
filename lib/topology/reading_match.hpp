#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "topology/experience.hpp"
#include "topology/star_catalogue.hpp"

namespace cairn {

/// How a visit misread the star of the place where it was.
enum class Misreading : std::uint8_t {
  kNone,           ///< Both stars look the same.
  kFragments,      ///< The gateways are right, but not how fragments join them or end between them.
  kMissedGateway,  ///< One gateway of the place was overlooked.
  kFalseGateway,   ///< One gateway was seen that the place does not have.
};

/// What a misreading takes from the log-likelihood (nats), each >= 0. Infinite costs, the default,
/// mean that only exact agreement counts.
struct MisreadingCosts {
  double log_penalty_misread = std::numeric_limits<double>::infinity();  ///< Of kFragments.
  double log_penalty_missed_gateway = std::numeric_limits<double>::infinity();
  double log_penalty_false_gateway = std::numeric_limits<double>::infinity();
};

/// How a view agrees with the star of a place, the robot having come in by one of its gateways.
struct ReadingMatch {
  /// Of the best reading: its own, less the cost of its misreading. Minus infinity: the view cannot
  /// be of this place, and nothing below tells anything.
  double log_likelihood = -std::numeric_limits<double>::infinity();
  Misreading misreading = Misreading::kNone;  ///< What the best reading is blamed for.
  int reading = 0;  ///< The best one; the first of those that are equally good.
  /// Gateways that could equally well be the missed or the false one: 0 if none is, or if the
  /// fragments were misread as well.
  int alternatives = 0;
  /// For each gateway of the view's first reading the place's gateway that it is; -1: none of them,
  /// as it is a false one or the best reading does not have it.
  std::vector<int> gateway_of_view;

  [[nodiscard]] bool is_possible() const {
    return log_likelihood > -std::numeric_limits<double>::infinity();
  }
  friend bool operator==(const ReadingMatch&, const ReadingMatch&) = default;
};

/// How many gateways could be the missed or the false one, or 1 if there is none such. First come
/// those that could equally well be it, then those that take misread fragments as well; clockwise
/// from the arrival.
[[nodiscard]] int choice_count(const View& view, const ReadingMatch& match);

/// Compares every reading of the view, entered by its arrival gateway, with the star of a place,
/// entered by one of its own. A recalled reading that is exactly alike comes before those that
/// would have to be misread. At most one gateway may be missed or false; if without it all else is
/// not alike (see without_gateway()), the fragments were misread too. Stars with more differences
/// cannot be of one place. Gateways keep their clockwise order, and the arrival is the arrival.
/// @param choice which gateway is taken for the missed or the false one
/// Source: test (a) of matching views in Kuipers et al., ICRA 2004, Sec. III-D, with an allowance
/// for perception that errs.
/// @pre view and place_star are valid, place_star has the gateway, costs are not negative; the
/// choice is below choice_count()
[[nodiscard]] ReadingMatch match_reading(const View& view,
                                         const Star& place_star,
                                         int arrival_gateway_of_place,
                                         const MisreadingCosts& costs,
                                         int choice = 0);

/// The star of a place as one visit corrects it, told as MapChange::kOtherStar expects it.
struct AmendedStar {
  /// The visit's reading; its gateways are numbered in the order of the place's old gateways.
  Star star;
  /// Of an additional gateway the number in `star`, never 0; of a dropped one the number in the old
  /// star; -1 where all gateways stay.
  int changed_gateway = -1;
  /// For each gateway of the view's first reading its number in `star`; -1 where the reading that
  /// amends does not have it.
  std::vector<int> gateway_of_view;
};

/// The place's star replaced by what a reading of this visit says, where not this visit but the
/// earlier one misread: kMissedGateway drops a gateway of the place, kFalseGateway adds one,
/// kFragments leaves all gateways. Gateways correspond as in match_reading().
/// @return nothing if the reading looks like the place's star already, or cannot be of this place
/// @pre as of match_reading(); 0 <= reading < reading_count(view)
[[nodiscard]] std::optional<AmendedStar> amended(const View& view,
                                                 int reading,
                                                 const Star& place_star,
                                                 int arrival_gateway_of_place,
                                                 int choice = 0);

/// Answers match_reading() of one view for the stars of a catalogue, each compared once. The
/// question of exact agreement is one comparison of view classes.
class ReadingMatcher {
 public:
  /// @param view outlives the matcher unchanged
  /// @param stars outlives the matcher; it may grow
  /// @pre view is valid, the catalogue has the stars of its readings, costs are not negative
  ReadingMatcher(const View& view, const StarCatalogue& stars, const MisreadingCosts& costs);

  /// Whether the likeliest reading (the first of them) looks exactly like this place.
  /// @pre the catalogue has the star, and it the gateway
  [[nodiscard]] bool is_exact(StarId star, int gateway) const {
    return stars_->view_class(star, gateway) == likeliest_class_;
  }

  /// What match_reading() says of the place with this star, entered by this gateway.
  /// @return valid as long as the matcher
  /// @pre the catalogue has the star, and it the gateway
  [[nodiscard]] const ReadingMatch& match(StarId star, int gateway, int choice = 0) {
    if (is_exact(star, gateway)) {
      return exact_[static_cast<std::size_t>(gateway)];
    }
    return is_strict_ ? impossible_ : remembered(star, gateway, choice);
  }

  [[nodiscard]] const View& view() const { return *view_; }
  /// @pre 0 <= reading < reading_count(view())
  [[nodiscard]] StarId star_id(int reading) const {
    return star_ids_[static_cast<std::size_t>(reading)];
  }

 private:
  [[nodiscard]] const ReadingMatch& remembered(StarId star, int gateway, int choice);

  const View* view_;
  const StarCatalogue* stars_;
  MisreadingCosts costs_;
  std::vector<StarId> star_ids_;  ///< By reading.
  ViewClassId likeliest_class_;
  std::vector<ReadingMatch> exact_;  ///< Of the likeliest reading, by gateway of the place.
  ReadingMatch impossible_;
  bool is_strict_ = false;  ///< One reading, and no misreading can be.
  /// By choice, star and gateway. Answers stay where they are while the outer vectors grow.
  std::vector<std::vector<std::vector<std::optional<ReadingMatch>>>> memo_;
};

}  // namespace cairn
