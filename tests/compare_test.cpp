// What `cutbench compare` calls slower, other, accepted and not comparable.
#include "harness/records/compare.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "harness/base/errors.h"

namespace cutbench {
namespace {

TrackFile two_rows() {
  TrackFile file;
  file.name = "base.json";
  file.tools = {{"compiler", "g++ 12"}, {"valgrind", "3.19"}};
  file.rows = {{.id = "trace/800",
                .phase = "trace",
                .unit = "crossed triangles",
                .fingerprint = "aa",
                .units = 100,
                .instructions = 1000000,
                .misses = 10000,
                .counters = {{"allocations", 0}}},
               {.id = "step/cg/800",
                .phase = "step",
                .unit = "elements",
                .fingerprint = "bb",
                .units = 800,
                .instructions = 5000000,
                .misses = 100,
                .counters = {{"iterations", 40}}}};
  return file;
}

Comparison compared(const TrackFile& head, const std::map<std::string, std::string>& accepted = {}) {
  return compare(two_rows(), head, {}, accepted);
}

std::string line(const std::string& text, int number) {
  std::size_t begin = 0;
  for (int i = 0; i < number; ++i) begin = text.find('\n', begin) + 1;
  return text.substr(begin, text.find('\n', begin) - begin);
}

TEST(Compare, SameIsNotSlower) {
  const Comparison c = compared(two_rows());
  EXPECT_FALSE(c.is_slower());
  EXPECT_TRUE(c.changes.empty() && c.different.empty() && c.added.empty() && c.not_comparable.empty());
  EXPECT_EQ(line(as_text(c, two_rows(), two_rows()), 0), "nothing slower of 2");
}

TEST(Compare, InstructionsAtTheThreshold) {
  TrackFile head = two_rows();
  head.rows[0].instructions = 1004999;
  EXPECT_FALSE(compared(head).is_slower());
  head.rows[0].instructions = 1005100;
  const Comparison c = compared(head);
  EXPECT_TRUE(c.is_slower());
  const std::string text = as_text(c, two_rows(), head);
  EXPECT_EQ(line(text, 0), "SLOWER: 1 rows of 2");
  EXPECT_EQ(line(text, 1), "worst: phase trace, row trace/800: instructions +0.51 %");
}

TEST(Compare, FewMissesAreNoFinding) {
  TrackFile head = two_rows();
  head.rows[1].misses = 110;  // a tenth more, of a hundred
  EXPECT_FALSE(compared(head).is_slower());
  head.rows[0].misses = 11000;
  EXPECT_TRUE(compared(head).is_slower());
}

TEST(Compare, CountersMayNotRise) {
  TrackFile head = two_rows();
  head.rows[0].counters["allocations"] = 1;
  head.rows[1].counters["iterations"] = 41;
  const Comparison c = compared(head);
  ASSERT_EQ(c.changes.size(), 2u);
  EXPECT_EQ(c.changes[0].what, "allocations");  // from 0: the biggest
  EXPECT_EQ(c.changes[1].what, "iterations");
}

TEST(Compare, BiggestFirstAndFasterLast) {
  TrackFile head = two_rows();
  head.rows[0].instructions = 500000;
  head.rows[0].misses = 12000;
  head.rows[1].instructions = 6500000;
  const Comparison c = compared(head);
  ASSERT_EQ(c.changes.size(), 3u);
  EXPECT_EQ(c.changes[0].id, "step/cg/800");
  EXPECT_EQ(c.changes[1].what, "misses");
  EXPECT_TRUE(c.changes[2].faster);
}

TEST(Compare, AnotherResultIsNotSlower) {
  TrackFile head = two_rows();
  head.rows[1].fingerprint = "cc";
  const Comparison c = compared(head);
  EXPECT_FALSE(c.is_slower());
  EXPECT_EQ(c.different, std::vector<std::string>{"step/cg/800"});
}

TEST(Compare, AcceptedByName) {
  TrackFile head = two_rows();
  head.rows[0].instructions *= 2;
  const std::string message = "Trace looks twice\n\nslower: trace/800, it is exact now\nslower: nothing\n";
  EXPECT_TRUE(compared(head).is_slower());
  const Comparison c = compared(head, read_accepted(message));
  EXPECT_FALSE(c.is_slower());
  EXPECT_NE(as_markdown(c, two_rows(), head).find("accepted: it is exact now"), std::string::npos);
  EXPECT_TRUE(compared(head, {{"step/cg/800", "another row"}}).is_slower());
}

TEST(Compare, OtherToolsOrMissingRows) {
  TrackFile head = two_rows();
  head.tools["compiler"] = "clang 14";
  EXPECT_NE(compared(head).not_comparable.find("compiler"), std::string::npos);
  head = two_rows();
  head.tools.erase("valgrind");
  EXPECT_NE(compared(head).not_comparable.find("valgrind"), std::string::npos);
  head = two_rows();
  head.rows.pop_back();
  EXPECT_NE(compared(head).not_comparable.find("step/cg/800"), std::string::npos);
  head = two_rows();
  head.rows.push_back(head.rows[0]);
  head.rows.back().id = "new/800";
  EXPECT_TRUE(compared(head).not_comparable.empty());
  EXPECT_EQ(compared(head).added, std::vector<std::string>{"new/800"});
}

struct Folder {
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
    return (path / name).string();
  }
  std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "cutbench_compare";
};

TEST(Compare, ThresholdsByTheLongestPrefix) {
  const Folder folder;
  const ThresholdTable table(folder.write(
      "t.toml", "instructions = 1.01\n[rows.\"step/\"]\ninstructions = 1.1\n[rows.\"step/cg\"]\nmisses = 2.0\n"));
  EXPECT_EQ(table.of("trace/800").instructions, 1.01);
  EXPECT_EQ(table.of("step/multigrid/800").instructions, 1.1);
  EXPECT_EQ(table.of("step/cg/800").instructions, 1.01);
  EXPECT_EQ(table.of("step/cg/800").misses, 2);
  EXPECT_THROW(ThresholdTable(folder.write("bad.toml", "instruction = 1.01\n")), InputError);
}

TEST(Compare, FilesThatAreNone) {
  const Folder folder;
  const std::string row = R"({"id": "a", "phase": "p", "unit": "u", "units": 1, "instructions": 2, "misses": 3,
      "counters": {"n": 4}, "fingerprint": "f"})";
  const auto file = [&](const std::string& text) { return read_track_file(folder.write("f.json", text)); };
  const TrackFile good = file(R"({"format": 1, "commit": "c", "tools": {"x": "1"}, "rows": [)" + row + "]}");
  EXPECT_EQ(good.rows.at(0).counters.at("n"), 4);
  for (const std::string& text :
       {std::string("nonsense"), std::string("{}"), std::string(R"({"format": 2, "tools": {}, "rows": []})"),
        R"({"format": 1, "tools": {}, "rows": [)" + row + ", " + row + "]}",
        std::string(R"({"format": 1, "tools": {}, "rows": [{"id": "a"}]})")})
    EXPECT_THROW(file(text), InputError) << text;
  EXPECT_THROW(read_track_file((folder.path / "none.json").string()), InputError);
}

TEST(Compare, JsonSaysTheVerdict) {
  TrackFile head = two_rows();
  head.rows[0].instructions *= 2;
  const auto json = nlohmann::json::parse(as_json(compared(head), two_rows(), head));
  EXPECT_EQ(json.at("verdict"), "slower");
  EXPECT_EQ(json.at("changes").at(0).at("row"), "trace/800");
}

}  // namespace
}  // namespace cutbench
