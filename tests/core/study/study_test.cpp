// SPDX-License-Identifier: GPL-3.0-or-later
// Good studies give the runs that they ask for; wrong ones the mistake that stands in them.
#include "core/study/study.hpp"
#include "core/study/study_plan.hpp"
#include "tests/support/results_helpers.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace plyform {
namespace {

namespace fs = std::filesystem;
using results_test::put;

/// A folder with a small case of its own and a study beside it.
class StudyFile : public results_test::ResultFolder {
protected:
  void SetUp() override {
    ResultFolder::SetUp();
    fs::create_directories(directory / "strip");
    fs::copy_file(fs::path(PLYFORM_CASES) / "fabrics/glass_plain_weave.toml",
                  directory / "glass.toml");
    put(directory / "strip/case.toml", R"(title = "Strip"
[fabrics]
glass = "../glass.toml"
[blanks.strip]
size = [120.0, 40.0]
mesh = "crossed"
element_size = 10.0
[[ply]]
name = "strip"
fabric = "glass"
blank = "strip"
angle = 45.0
[solver]
step_factor = 0.8
duration = 0.01
)");
  }
  fs::path file() const { return directory / "study.toml"; }
  StudyReading read(const std::string& text) const {
    put(file(), text);
    return read_study(file());
  }
  /// A study that must be right.
  Study good(const std::string& text) const {
    const StudyReading reading = read(text);
    for (const CaseError& error : reading.errors)
      ADD_FAILURE() << error.text();
    return reading.value.value_or(Study{});
  }
};

const StudyRun* run_named(const StudyPlan& plan, const std::string& name) {
  const auto it = std::find_if(plan.runs.begin(), plan.runs.end(),
                               [&](const StudyRun& run) { return run.name == name; });
  return it == plan.runs.end() ? nullptr : &*it;
}

using Settings = std::vector<std::string>;

TEST_F(StudyFile, NeedsNoMoreThanACase) {
  const Study study = good("case = \"strip\"\n");
  EXPECT_EQ(study.title, "study");
  EXPECT_EQ(study.case_file, directory / "strip/case.toml");
  EXPECT_EQ(study.presets, (Settings{"draft", "standard", "reference"}));
  EXPECT_TRUE(study.dials.empty() && study.settings.empty());
  const StudyPlan plan = plan_study(study);
  Settings names;
  for (const StudyRun& run : plan.runs)
    names.push_back(run.name);
  EXPECT_EQ(names,
            (Settings{"reference", "case", "preset=draft", "preset=standard", "preset=reference"}));
  EXPECT_EQ(plan.runs[2].accuracy, "draft");
  EXPECT_EQ(plan.runs[1].accuracy, "");
}

TEST_F(StudyFile, SetsTheReferenceFinerByItsFactors) {
  const StudyPlan plan = plan_study(good(R"(case = "strip/case.toml"
settings = ["solver.outputs=2"]
[reference]
step = 0.25
element_size = 0.5
settings = ["solver.duration=0.03", "solver.fibre_softening=25"]
)"));
  EXPECT_EQ(
      plan.runs[0].settings,
      (Settings{"solver.outputs=2", "solver.duration=0.03", "solver.fibre_softening=25",
                "solver.step_factor=0.2", "solver.duration=0.06", "blanks.strip.element_size=5"}));
  EXPECT_EQ(plan.runs[1].settings, Settings{"solver.outputs=2"});
}

constexpr const char* three_dials = R"(title = "Three"
case = "strip"
presets = ["draft"]
[[dial]]
name = "fibre softening"
key = "solver.fibre_softening"
values = [1, 10, 1e2]
[[dial]]
name = "size"
key = "element_size"
values = [2.0, 1.0, 0.5]
[[dial]]
name = "mesh"
key = "blanks.strip.mesh"
values = ["diagonal", "crossed"]
)";

TEST_F(StudyFile, MakesARunOfEachValueThatIsNotTheCasesOwn) {
  const StudyPlan plan = plan_study(good(three_dials));
  Settings names;
  for (const StudyRun& run : plan.runs)
    names.push_back(run.name);
  EXPECT_EQ(names, (Settings{"reference", "case", "preset=draft", "fibre_softening=10",
                             "fibre_softening=1e2", "size=2.0", "size=0.5", "mesh=diagonal",
                             "mesh=crossed"}));
  ASSERT_EQ(plan.points.size(), 3u + 3u + 3u + 2u);
  EXPECT_EQ(plan.points[3].setting, "solver.fibre_softening=1"); // a default: in no file
  EXPECT_EQ(plan.points[3].run, 1u);
  EXPECT_EQ(plan.points[7].setting, "element_size=1.0");
  EXPECT_EQ(plan.points[7].run, 1u);
  EXPECT_EQ(run_named(plan, "fibre_softening=1e2")->settings,
            Settings{"solver.fibre_softening=1e2"});
  EXPECT_EQ(run_named(plan, "size=2.0")->settings, Settings{"blanks.strip.element_size=20"});
  EXPECT_EQ(plan.own[0], 1.0);
  EXPECT_EQ(plan.own[1], 1.0);
  EXPECT_TRUE(std::isnan(plan.own[2]));
  for (const StudyPoint& point : plan.points)
    EXPECT_LT(point.run, plan.runs.size());
}

TEST_F(StudyFile, TellsInputsApartByWhatTheResultsDependOn) {
  const Study study = good(three_dials);
  const StudyPlan before = plan_study(study);
  std::set<std::string> all;
  for (const StudyRun& run : before.runs)
    EXPECT_TRUE(all.insert(run.inputs).second) << run.inputs;
  EXPECT_EQ(plan_study(study).runs[3].inputs, before.runs[3].inputs);
  const std::string glass = results_test::content(directory / "glass.toml");
  put(directory / "glass.toml", glass + "\n# another\n");
  for (std::size_t i = 0; i < before.runs.size(); ++i)
    EXPECT_NE(plan_study(study).runs[i].inputs, before.runs[i].inputs) << before.runs[i].name;
  put(directory / "glass.toml", glass);
  EXPECT_EQ(plan_study(study).runs[3].inputs, before.runs[3].inputs);
}

TEST(Studies, ShippedAreSound) {
  int studies = 0;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(fs::path(PLYFORM_CASES) / "studies")) {
    const StudyReading reading = read_study(entry.path());
    for (const CaseError& error : reading.errors)
      ADD_FAILURE() << error.text();
    EXPECT_TRUE(reading.value && !reading.value->dials.empty());
    ++studies;
  }
  EXPECT_EQ(studies, 8);
}

// ---- mistakes ----

struct Mistake {
  const char *name, *text, *place, *fragment; ///< place: LINE:COLUMN
};

const Mistake mistakes[] = {
    {"unknown", "case = \"strip\"\npresents = []\n", "2:1",
     "presents = []: unknown key, the study has no presents; did you mean presets?"},
    {"no_case", "title = \"a\"\n", "1:1", "case: is missing; give the case file"},
    {"case_number", "case = 3\n", "1:8", "case = 3: must be a string"},
    {"case_absent", "case = \"nosuch\"\n", "1:8", "there is no file"},
    {"title", "case = \"strip\"\ntitle = []\n", "2:9", "title = []: must be a string"},
    {"syntax", "case = \"strip\n", "1:", "is no TOML"},
    {"settings", "case = \"strip\"\nsettings = \"a=b\"\n", "2:12", "must be a list"},
    {"setting", "case = \"strip\"\nsettings = [\"solver.outputs\"]\n", "2:13",
     "settings.0 = \"solver.outputs\": must be a string KEY=VALUE"},
    {"setting_key", "case = \"strip\"\nsettings = [\"solver.outputs=2\", \"solver.out=2\"]\n",
     "2:33", "solver has no out"},
    {"setting_value", "case = \"strip\"\nsettings = [\"solver.outputs=0\"]\n", "2:13",
     "does not fit the case: solver.outputs = 0 must be at least 1 and at most 100000; give the "
     "number of states"},
    {"preset", "case = \"strip\"\npresets = [\"daft\"]\n", "2:12",
     "presets.0 = \"daft\": must be one of draft, standard, reference"},
    {"preset_twice", "case = \"strip\"\npresets = [\"draft\", \"draft\"]\n", "2:21",
     "stands twice"},
    {"reference", "case = \"strip\"\nreference = 3\n", "2:13", "must be a table"},
    {"reference_key", "case = \"strip\"\n[reference]\nsteps = 3\n", "3:1", "did you mean step?"},
    {"factor", "case = \"strip\"\n[reference]\nstep = -1\n", "3:8",
     "reference.step = -1: must be a number greater than 0"},
    {"factor_large", "case = \"strip\"\n[reference]\nstep = 2.0\n", "3:8",
     "does not fit the case: solver.step_factor = 1.6"},
    {"reference_setting", "case = \"strip\"\n[reference]\nsettings = [\"gravity=1\"]\n", "3:13",
     "reference.settings.0"},
    {"dial_table", "case = \"strip\"\n[dial]\nname = \"a\"\n", "2:1", "under [[dial]]"},
    {"dial_name", "case = \"strip\"\n[[dial]]\nkey = \"solver.duration\"\nvalues = [1]\n", "2:1",
     "dial.0.name: is missing"},
    {"dial_reserved",
     "case = \"strip\"\n[[dial]]\nname = \"case\"\nkey = \"solver.duration\"\nvalues = [1]\n",
     "3:8", "is the name of another line"},
    {"dial_twice",
     "case = \"strip\"\n[[dial]]\nname = \"a b\"\nkey = \"solver.duration\"\nvalues = [1]\n"
     "[[dial]]\nname = \"a_b\"\nkey = \"solver.outputs\"\nvalues = [1]\n",
     "7:8", "is the name of another line"},
    {"dial_unknown",
     "case = \"strip\"\n[[dial]]\nname = \"a\"\nkey = \"solver.outputs\"\nvalue = [1]\n"
     "values = [1]\n",
     "5:1", "did you mean values?"},
    {"dial_values", "case = \"strip\"\n[[dial]]\nname = \"a\"\nkey = \"solver.outputs\"\n", "2:1",
     "dial.0.values: is missing"},
    {"dial_empty",
     "case = \"strip\"\n[[dial]]\nname = \"a\"\nkey = \"solver.outputs\"\nvalues = []\n", "5:10",
     "at least one value"},
    {"dial_value_twice",
     "case = \"strip\"\n[[dial]]\nname = \"a\"\nkey = \"solver.outputs\"\nvalues = [1, 2, 1]\n",
     "5:17", "stands twice"},
    {"dial_value_kind",
     "case = \"strip\"\n[[dial]]\nname = \"a\"\nkey = \"solver.outputs\"\nvalues = [1, []]\n",
     "5:14", "must be a number or a word"},
    {"dial_key",
     "case = \"strip\"\n[[dial]]\nname = \"a\"\nkey = \"solver.softness\"\nvalues = [1, 2]\n",
     "4:7", "does not fit the case"},
    {"dial_value",
     "case = \"strip\"\n[[dial]]\nname = \"a\"\nkey = \"solver.fibre_softening\"\n"
     "values = [2, 0.5, 10]\n",
     "5:14", "values.1 = 0.5: does not fit the case: solver.fibre_softening = 0.5 must be at "},
    {"dial_factor",
     "case = \"strip\"\n[[dial]]\nname = \"a\"\nkey = \"element_size\"\nvalues = [1, 0.0]\n",
     "5:14", "must be a number greater than 0; give a factor"},
    {"dial_factor_large",
     "case = \"strip\"\n[[dial]]\nname = \"a\"\nkey = \"element_size\"\nvalues = [1, 50]\n", "5:14",
     "larger than the blank's smallest width"},
};

TEST_F(StudyFile, TellsEachMistakeWithItsPlace) {
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.name);
    const StudyReading reading = read(mistake.text);
    EXPECT_FALSE(reading.value);
    ASSERT_EQ(reading.errors.size(), 1u);
    const std::string text = reading.errors.front().text();
    EXPECT_TRUE(text.starts_with(file().string() + ":" + mistake.place)) << text;
    EXPECT_TRUE(results_test::contains(text, mistake.fragment)) << text;
    EXPECT_FALSE(reading.errors.front().remedy.empty()) << text;
  }
}

TEST_F(StudyFile, TellsAllItsMistakesAtOnceByLine) {
  const StudyReading reading = read(R"(case = "strip"
[reference]
step = "a"
[[dial]]
name = "a"
values = [1, 1]
[[dial]]
key = 3
)");
  std::string lines;
  for (const CaseError& error : reading.errors)
    lines += std::to_string(error.line) + " ";
  EXPECT_EQ(lines, "3 4 6 7 7 8 ");
}

TEST_F(StudyFile, TellsMistakesOfTheCaseWithTheirPlaceThere) {
  const std::string strip = results_test::content(directory / "strip/case.toml");
  put(directory / "strip/case.toml", strip + "outpust = 3\n");
  const StudyReading reading = read("case = \"strip\"\n");
  ASSERT_EQ(reading.errors.size(), 1u);
  EXPECT_EQ(fs::path(reading.errors[0].file), directory / "strip/case.toml");
  EXPECT_EQ(reading.errors[0].line, 16);
}

TEST_F(StudyFile, ThatIsNotThereIsReported) {
  const StudyReading reading = read_study(directory / "absent.toml");
  ASSERT_EQ(reading.errors.size(), 1u);
  EXPECT_TRUE(
      results_test::contains(reading.errors[0].text(), "absent.toml:1:1: error: the study"));
}

} // namespace
} // namespace plyform
