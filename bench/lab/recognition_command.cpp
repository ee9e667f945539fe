#include "bench/lab/recognition_command.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bench/lab/recognition_fit.hpp"
#include "bench/lab/recognition_pairs.hpp"
#include "bench/lab/recognition_picture.hpp"
#include "clients/common/text.hpp"
#include "clients/common/within.hpp"

namespace cairn::lab {
namespace {

using clients::fixed;
using OrderedJson = nlohmann::ordered_json;

struct RecognitionRequest {
  int worlds = 14;
  std::uint64_t seed = 1;
  std::string png_file;
  std::string csv_file;
  bool as_json = false;
};

/// What the judgements on one set of buildings are worth.
struct Scores {
  std::string name;
  int same = 0;
  int different = 0;
  double log_loss = 0.0;
  std::vector<ReliabilityBin> bins;
  std::vector<ErrorRates> curve;
};

struct RecognitionReport {
  Eigen::VectorXd weights;  ///< Fitted to the buildings to learn from.
  std::vector<Scores> scores;
  double mean_chi2 = 0.0;       ///< Of alignments of the same, the worst hundredth left out.
  double chi2_beyond_11 = 0.0;  ///< Share that exceeds what one in a hundred should.
  int chi2_count = 0;
};

Example example_of(const JudgedPair& pair) {
  const MatchFeatures features = features_of(pair.match);
  return {Eigen::Map<const Eigen::VectorXd>(features.data(),
                                            static_cast<Eigen::Index>(features.size())),
          pair.is_same};
}

Scores scores_of(std::string name, const std::vector<Judgement>& judgements) {
  Scores scores;
  scores.name = std::move(name);
  for (const Judgement& judgement : judgements) {
    (judgement.is_same ? scores.same : scores.different) += 1;
  }
  scores.log_loss = log_loss(judgements);
  scores.bins = reliability(judgements);
  for (double threshold = -8.0; threshold <= 8.0; threshold += 1.0) {
    scores.curve.push_back(error_rates(judgements, threshold));
  }
  return scores;
}

/// Of those pairs that some question is about. Pairs without common ground count as well: of them
/// 0 is said.
template <typename Choice>
std::vector<Judgement> judgements_of(const std::vector<JudgedPair>& pairs, const Choice& choice) {
  std::vector<Judgement> judgements;
  for (const JudgedPair& pair : pairs) {
    if (choice(pair)) {
      judgements.push_back({pair.match.log_likelihood_ratio, pair.is_same});
    }
  }
  return judgements;
}

void judge_alignments(const std::vector<JudgedPair>& pairs, RecognitionReport* report) {
  std::vector<double> chi2;
  for (const JudgedPair& pair : pairs) {
    if (pair.is_same) {
      chi2.push_back(pair.chi2);
    }
  }
  std::sort(chi2.begin(), chi2.end());
  constexpr double kOneInAHundred = 11.34;  // of chi2 with three degrees of freedom
  for (std::size_t i = 0; i < chi2.size(); ++i) {
    const bool is_kept = i + 1 + chi2.size() / 100 <= chi2.size();
    report->mean_chi2 += is_kept ? chi2[i] : 0.0;
    report->chi2_count += is_kept ? 1 : 0;
    report->chi2_beyond_11 += chi2[i] > kOneInAHundred ? 1.0 / static_cast<double>(chi2.size()) : 0;
  }
  report->mean_chi2 /= std::max(report->chi2_count, 1);
}

RecognitionReport report_on(const std::vector<JudgedPair>& learnt,
                            const std::vector<JudgedPair>& held_out) {
  std::vector<Example> examples;
  for (const JudgedPair& pair : learnt) {
    if (pair.match.overlap_share >= MapMatchOptions().min_overlap_share) {
      examples.push_back(example_of(pair));
    }
  }
  RecognitionReport report;
  report.weights = fitted_weights(examples);
  const auto all = [](const JudgedPair&) { return true; };
  report.scores.push_back(scores_of("all", judgements_of(held_out, all)));
  report.scores.push_back(scores_of(
      "buildings that repeat themselves",
      judgements_of(held_out, [](const JudgedPair& pair) { return pair.repeats_itself; })));
  report.scores.push_back(scores_of(
      "across sessions",
      judgements_of(held_out, [](const JudgedPair& pair) { return pair.is_other_session; })));
  judge_alignments(held_out, &report);
  return report;
}

OrderedJson json_of(const Scores& scores) {
  OrderedJson json = {{"pairs", scores.name},
                      {"same", scores.same},
                      {"different", scores.different},
                      {"log_loss", scores.log_loss},
                      {"reliability", OrderedJson::array()},
                      {"curve", OrderedJson::array()}};
  for (const ReliabilityBin& bin : scores.bins) {
    json["reliability"].push_back({{"from", bin.low},
                                   {"to", bin.high},
                                   {"same", bin.same},
                                   {"different", bin.different},
                                   {"predicted", bin.predicted},
                                   {"actual", bin.actual}});
  }
  for (const ErrorRates& rates : scores.curve) {
    json["curve"].push_back({{"threshold", rates.threshold},
                             {"false_match_share", rates.false_matches},
                             {"missed_match_share", rates.missed_matches}});
  }
  return json;
}

OrderedJson json_of(const RecognitionReport& report) {
  OrderedJson json = {
      {"weights", std::vector<double>(report.weights.begin(), report.weights.end())},
      {"held_out", OrderedJson::array()},
      {"alignment_mean_chi2", report.mean_chi2},
      {"alignment_share_beyond_99_percent", report.chi2_beyond_11}};
  for (const Scores& scores : report.scores) {
    json["held_out"].push_back(json_of(scores));
  }
  return json;
}

std::string percent(double share) {
  return fixed(100.0 * share, 2) + " %";
}

void print(const Scores& scores, std::ostream& out) {
  out << '\n'
      << scores.name << ": " << scores.same << " same, " << scores.different
      << " different; log loss " << fixed(scores.log_loss, 3) << " (ln 2 = 0.693 says nothing)\n";
  clients::Table reliability({"ratio", "same", "different", "predicted", "actual"});
  for (const ReliabilityBin& bin : scores.bins) {
    reliability.add({fixed(bin.low, 0) + " to " + fixed(bin.high, 0), std::to_string(bin.same),
                     std::to_string(bin.different), fixed(bin.predicted, 3), fixed(bin.actual, 3)});
  }
  reliability.print(out);
  clients::Table curve({"threshold", "false matches", "missed matches"});
  for (const ErrorRates& rates : scores.curve) {
    curve.add(
        {fixed(rates.threshold, 0), percent(rates.false_matches), percent(rates.missed_matches)});
  }
  curve.print(out);
}

void print(const RecognitionReport& report, std::ostream& out) {
  out << "weights fitted to the buildings to learn from:";
  for (const double weight : report.weights) {
    out << ' ' << fixed(weight, 3);
  }
  out << "\nalignments of the same: mean chi2 " << fixed(report.mean_chi2, 2)
      << " of 3, the worst hundredth left out; " << percent(report.chi2_beyond_11)
      << " beyond 11.34, where 1 % should be\n";
  for (const Scores& scores : report.scores) {
    print(scores, out);
  }
}

void write_pairs(const std::vector<JudgedPair>& pairs, const std::string& file) {
  std::string text =
      "seed,is_same,is_same_junction,is_other_session,repeats_itself,occupied_agreement,"
      "free_conflict,overlap_share,common_walls_m,shift_m,shift_rad,chi2,log_likelihood_ratio\n";
  for (const JudgedPair& pair : pairs) {
    const MapMatch& match = pair.match;
    text += std::to_string(pair.seed);
    for (const bool is :
         {pair.is_same, pair.is_same_junction, pair.is_other_session, pair.repeats_itself}) {
      text += is ? ",1" : ",0";
    }
    for (const double value :
         {match.occupied_agreement, match.free_conflict, match.overlap_share, match.common_walls_m,
          match.shift_m, match.shift_rad, pair.chi2, match.log_likelihood_ratio}) {
      text += ',' + fixed(value, 4);
    }
    text += '\n';
  }
  clients::write_file(file, text);
}

int experiment(const RecognitionRequest& request, const Streams& streams) {
  const std::vector<JudgedPair> learnt = judged_buildings(request.seed, request.worlds);
  const std::vector<JudgedPair> held_out =
      judged_buildings(request.seed + static_cast<std::uint64_t>(request.worlds), request.worlds);
  const RecognitionReport report = report_on(learnt, held_out);
  if (!request.csv_file.empty()) {
    std::vector<JudgedPair> all = learnt;
    all.insert(all.end(), held_out.begin(), held_out.end());
    write_pairs(all, request.csv_file);
  }
  if (!request.png_file.empty()) {
    std::vector<ErrorCurve> curves;
    for (const Scores& scores : report.scores) {
      curves.push_back({scores.name, scores.curve});
    }
    draw_error_curves(curves, request.png_file);
  }
  if (request.as_json) {
    streams.out << json_of(report).dump(2) << '\n';
  } else {
    print(report, streams.out);
  }
  return 0;
}

}  // namespace

void add_recognition_command(CLI::App& app, const Streams& streams, int* status) {
  CLI::App* command = app.add_subcommand(
      "recognition",
      "How far matching local maps tells places from alike ones, in simulated buildings");
  auto request = std::make_shared<RecognitionRequest>();
  command
      ->add_option("--worlds", request->worlds,
                   "Buildings to learn from, and as many others to judge")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command->add_option("--seed", request->seed, "Of the first building")
      ->check(clients::within(0.0, clients::kMostSeed))
      ->capture_default_str();
  command
      ->add_option("--png", request->png_file, "Draw false and missed matches over the threshold")
      ->type_name("FILE");
  command->add_option("--csv", request->csv_file, "Write every pair, with what was measured of it")
      ->type_name("FILE");
  command->add_flag("--json", request->as_json, "Print JSON");
  command->callback([request, streams, status] { *status = experiment(*request, streams); });
}

}  // namespace cairn::lab
