// What the program says to a user who waits or mistypes a name.
#include "harness/base/names.h"

#include <gtest/gtest.h>

#include "harness/study/progress.h"

namespace cutbench {
namespace {

TEST(Names, TheNearestComesFirst) {
  EXPECT_EQ(listed(nearest_first("gird", {"delaunay", "jittered", "grid"})), "grid, jittered, delaunay");
  EXPECT_EQ(listed(nearest_first("", {"abc", "xyz", "q"})), "q, abc, xyz");
  EXPECT_EQ(listed({}), "");
}

TEST(Names, OnlyANearOneIsSuggested) {
  EXPECT_EQ(suggestion("steps", {"name", "step"}, "else"), "did you mean \"step\"?");
  EXPECT_EQ(suggestion("resolutoin", {"size", "resolution"}, "else"), "did you mean \"resolution\"?");
  EXPECT_EQ(suggestion("foo", {"pins", "sheet"}, "else"), "else");
  EXPECT_EQ(suggestion("", {"a"}, "else"), "else");
  EXPECT_EQ(suggestion("a", {}, "else"), "else");
}

TEST(Progress, TimeLeftIsSaidOnceItMeansSomething) {
  EXPECT_EQ(time_left(4, 50, 100), "");
  EXPECT_EQ(time_left(60, 4, 100), "");
  EXPECT_EQ(time_left(60, 0, 100), "");
  EXPECT_EQ(time_left(60, 100, 100), "");
  EXPECT_EQ(time_left(60, 60, 100), ", about 40 s left at this rate");
  EXPECT_EQ(time_left(60, 20, 100), ", about 4 min left at this rate");
  EXPECT_EQ(time_left(3600, 10, 100), ", about 9 h left at this rate");
}

}  // namespace
}  // namespace cutbench
