// SPDX-License-Identifier: GPL-3.0-or-later
// The table of keys: all of them are used, described, and have defaults that the reader accepts.
#include "base/text.hpp"
#include "core/input/keys/schema_check.hpp"
#include "support/case_files.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace plyform::schema_test {
namespace {

/// All patterns of keys that stand in a file.
void collect_keys(const TomlNode& table, const std::string& pattern, std::set<std::string>& keys) {
  for (const TomlNode& child : table.children) {
    const std::string key =
        table.kind == TomlNode::Kind::list ? pattern + "[]" : pattern_of(pattern, child.key);
    if (table.kind == TomlNode::Kind::table) keys.insert(key);
    collect_keys(child, key, keys);
  }
}

/// The keys of case files (pattern "") or fabric files ("fabrics.NAME"), and those listed.
struct Keys {
  std::set<std::string> used, listed;
  Keys() {
    for (const KeyInfo& key : case_keys())
      listed.insert(key.key);
  }
  void add(const fs::path& file, const std::string& pattern) {
    std::string reason;
    Diagnostics diagnostics;
    const auto content = read_text(file, reason);
    ASSERT_TRUE(content) << reason;
    const auto entries = parse_entries(*content, file.string(), diagnostics);
    ASSERT_TRUE(entries) << file;
    collect_keys(*entries, pattern, used);
  }
};

TEST(CaseKeys, AreJustThoseThatGoodFilesUse) {
  Keys keys;
  for (const char* name :
       {"every_shape",      "inline",           "base",     "boundaries", "bending",
        "accuracy",         "profile_shapes",   "outlines", "springs",    "zones",
        "families",         "stitches",         "loads",    "compaction", "rubber",
        "enclosure",        "temperature",      "cooling",  "viscous",    "friction",
        "film_temperature", "shear_temperature"}) {
    good_case(data_folder / "good" / (std::string(name) + ".toml")); // each of its keys is accepted
    keys.add(data_folder / "good" / (std::string(name) + ".toml"), "");
  }
  for (const char* name : {"plain", "tables"}) // the fabrics of these cases
    keys.add(data_folder / "fabrics" / (std::string(name) + ".toml"), "fabrics.NAME");
  EXPECT_EQ(keys.used, keys.listed);
}

TEST(CaseKeys, CoverTheShippedCases) {
  Keys keys;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(PLYFORM_CASES))
    if (entry.path().extension() == ".toml" && !is_study(entry.path()))
      keys.add(entry.path(), is_fabric(entry.path()) ? "fabrics.NAME" : "");
  EXPECT_GT(keys.used.size(), 40u);
  for (const std::string& key : keys.used)
    EXPECT_TRUE(keys.listed.contains(key)) << key;
}

TEST(CaseKeys, AreDescribedAndListedOnce) {
  std::set<std::string> keys;
  for (const KeyInfo& key : case_keys()) {
    EXPECT_TRUE(keys.insert(key.key).second) << key.key;
    EXPECT_FALSE(key.type.empty() || key.unit.empty() || key.fallback.empty()) << key.key;
    EXPECT_FALSE(key.meaning.empty()) << key.key;
  }
}

TEST(CaseKeys, HaveDefaultsThatTheReaderAccepts) {
  for (const KeyRow& row : key_table()) {
    if (row.fallback.empty()) continue;
    std::string reason;
    const auto value = parse_value(row.fallback, "default", 1, reason);
    ASSERT_TRUE(value) << row.key << ": " << reason;
    if (value->is_number()) {
      EXPECT_TRUE(row.range_of(0).holds(value->number)) << row.key;
    }
  }
}

/// Whether the sums and squares of a run stay finite with any number of the range.
bool bounded(const Range& range) {
  return range.least >= -1e9 && range.most <= 1e9;
}

TEST(KeyTable, BoundsEveryNumberOnBothSides) {
  for (const KeyRow& row : key_table()) {
    const bool numbers = row.kind == KeyKind::number || row.kind == KeyKind::integer ||
                         row.kind == KeyKind::numbers || row.kind == KeyKind::pairs ||
                         row.kind == KeyKind::outlines || row.kind == KeyKind::profile;
    if (!numbers) continue;
    EXPECT_FALSE(row.ranges.empty()) << row.key;
    for (const Range& range : row.ranges)
      EXPECT_TRUE(bounded(range)) << row.key << " " << range.text();
    for (std::size_t column = 0; column < row.usual.size(); ++column) {
      EXPECT_TRUE(row.range_of(column).holds(row.usual[column].least)) << row.key;
      EXPECT_TRUE(row.range_of(column).holds(row.usual[column].most)) << row.key;
    }
  }
}

/// Keys of files that name another part, and where each stands in a good file.
struct Naming {
  std::string pattern, file, key;
};

const std::vector<Naming> namings{
    {"fabrics.NAME.crossing[].families", "families", "fabrics.triaxial.crossing.0.families.1"},
    {"blanks.NAME.zone[].tool", "zones", "blanks.square.zone.2.tool"},
    {"ply[].fabric", "friction", "ply.0.fabric"},
    {"ply[].blank", "friction", "ply.0.blank"},
    {"boundary[].ply", "springs", "boundary.2.ply"},
    {"boundary[].carried_by", "springs", "boundary.0.carried_by"},
    {"contact.friction_law", "friction", "contact.friction_law"},
    {"contact.pair[].between", "friction", "contact.pair.0.between.1"},
    {"contact.pair[].friction_law", "friction", "contact.pair.0.friction_law"},
    {"load[].ply", "loads", "load.0.ply"},
    {"load[].between", "enclosure", "load.0.between.0"}};

TEST(CaseKeys, SayOfWhichPartsTheyAreNames) {
  const std::set<std::string> free{"title", "fabrics.NAME.name", "blanks.NAME.layer",
                                   "blanks.NAME.mesh_from"};
  std::set<std::string> referring, tried;
  for (const KeyRow& row : key_table()) {
    const bool text = row.kind == KeyKind::text || row.kind == KeyKind::names;
    EXPECT_EQ(text && row.refers.empty(), free.contains(row.key)) << row.key;
    if (!row.refers.empty()) referring.insert(row.key);
    for (const std::string& part : row.refers) {
      const KeyRow* named = find_key(part);
      ASSERT_TRUE(named) << row.key << " " << part;
      EXPECT_TRUE(named->kind == KeyKind::map || find_key(part + "[].name")) << row.key;
    }
  }
  for (const Naming& one : namings)
    tried.insert(one.pattern);
  EXPECT_EQ(referring, tried);
}

TEST(CaseKeys, ThatNameNoPartAreToldWithTheNamesThatThereAre) {
  for (const Naming& one : namings) {
    const fs::path file = data_folder / "good" / (one.file + ".toml");
    const PreparedCase reading = prepare_case(file, {{one.key, "nobody"}});
    const auto told = [&](const CaseError& error) {
      return error.item == one.key && error.value == "nobody" &&
             error.rule.starts_with("names no ") && !error.remedy.empty();
    };
    EXPECT_TRUE(std::any_of(reading.errors.begin(), reading.errors.end(), told))
        << one.key << "\n"
        << all_texts(reading);
  }
}

} // namespace
} // namespace plyform::schema_test
