// SPDX-License-Identifier: GPL-3.0-or-later
// What came of a study's runs: chart.csv, and the content of chart.svg.
#pragma once

#include "core/results/field_difference.hpp"
#include "core/study/chart_svg.hpp"
#include "core/study/study_plan.hpp"

#include <limits>
#include <string>
#include <vector>

namespace plyform {

struct RunOutcome {
  std::string status; ///< done, doubtful, stopped (by plyform itself), failed (anything else)
  double wall_time_s = 0;
  double cpu_s = std::numeric_limits<double>::quiet_NaN(); ///< of all threads; NaN: not known
  long steps = 0, elements = 0;
  double promised_deg = std::numeric_limits<double>::quiet_NaN(); ///< NaN: nothing promised
  FieldError error{std::numeric_limits<double>::quiet_NaN(),
                   std::numeric_limits<double>::quiet_NaN(),
                   std::numeric_limits<double>::quiet_NaN()}; ///< NaN if it did not end
};

/// All but cpu_s and error, from the content of a summary.json. Status "failed", and nothing else,
/// if it is no such content: empty, cut off, no JSON, or something else where a number should
/// stand.
RunOutcome read_outcome(const std::string& summary_json);

/// By run: whether it is done (or doubtful) and no other run is as fast and as near to the
/// reference, and better in one of the two. Never the reference, which is the measure.
std::vector<bool> on_front(const StudyPlan& plan, const std::vector<RunOutcome>& outcomes);

/// One row a point of the plan; `outcomes` by run. Columns: docs/users/chart.md.
std::string chart_csv(const StudyPlan& plan, const std::vector<RunOutcome>& outcomes);

/// `note`: in small letters below the title.
Chart study_chart(const Study& study, const StudyPlan& plan,
                  const std::vector<RunOutcome>& outcomes, const std::string& note);

} // namespace plyform
