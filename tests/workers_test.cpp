// Threads that share loops: each job is done once, sums are the same bits, and what goes wrong in a job reaches the
// caller.
#include "harness/fem/algebra/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "tests/helpers.h"
#include "tests/mesh_checks.h"

namespace cutbench {
namespace {

const std::vector<int> numbers_of_threads{1, 2, 3, 7};

TEST(Workers, DoEachJobOnce) {
  for (const int threads : numbers_of_threads) {
    Workers workers(threads);
    EXPECT_EQ(workers.threads(), threads);
    for (const std::size_t jobs : {0, 1, 2, 5, 1000}) {
      std::vector<int> done(jobs);
      workers.run(jobs, [&](std::size_t k) { ++done[k]; });
      EXPECT_EQ(done, std::vector<int>(jobs, 1));
    }
  }
}

TEST(Workers, ManySmallTasks) {
  for (const int threads : numbers_of_threads) {
    Workers workers(threads);
    std::vector<std::size_t> sums(4);
    for (std::size_t task = 0; task < 5000; ++task)
      workers.run(sums.size(), [&](std::size_t k) { sums[k] += task * k; });
    for (std::size_t k = 0; k < sums.size(); ++k) EXPECT_EQ(sums[k], k * 4999 * 5000 / 2);
  }
}

/// What the threads have written is there after the call, and what was written before it is there for them.
TEST(Workers, ATaskSeesTheOneBefore) {
  Workers workers(3);
  std::vector<int> values(64, 1);
  for (int task = 0; task < 1000; ++task) {
    std::vector<int> next(values.size());
    workers.run(values.size(), [&](std::size_t k) { next[k] = values[(k + 1) % values.size()] + 1; });
    values = next;
  }
  EXPECT_EQ(values, std::vector<int>(64, 1001));
}

TEST(Workers, RangesMakeUpAll) {
  for (const int threads : numbers_of_threads) {
    Workers workers(threads);
    for (const std::size_t n : {0, 1, 511, 512, 513, 5000, 100'000}) {
      std::vector<int> done(n);
      workers.for_ranges(n, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++done[i];
      });
      EXPECT_EQ(done, std::vector<int>(n, 1));
    }
  }
}

TEST(Workers, SumsAreTheSameBits) {
  Random random(5);
  std::vector<double> values(100'000);
  for (double& value : values) value = random.between(-1, 1);
  const auto sum = [&](int threads, std::size_t n) {
    Workers workers(threads);
    return workers.sum_ranges(n, [&](std::size_t begin, std::size_t end) {
      double part = 0;
      for (std::size_t i = begin; i < end; ++i) part += values[i];
      return part;
    });
  };
  for (const std::size_t n : {0, 1, 512, 513, 6561, 100'000})
    for (const int threads : numbers_of_threads) EXPECT_EQ(sum(threads, n), sum(1, n)) << n;
}

TEST(Workers, WhatAJobThrowsReachesTheCaller) {
  for (const int threads : numbers_of_threads) {
    Workers workers(threads);
    for (int round = 0; round < 50; ++round) {
      try {
        workers.run(20, [](std::size_t k) {
          if (k == 7) throw std::runtime_error("job " + std::to_string(k));
        });
        FAIL();
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), std::string("job 7"));
      }
      std::atomic<int> done = 0;  // and the next task is done
      workers.run(20, [&](std::size_t) { ++done; });
      EXPECT_EQ(done, 20);
    }
  }
}

TEST(Workers, OfManyFailuresTheFirstOfThoseThatHappened) {
  Workers workers(3);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::uint8_t> thrown(8);
    try {
      workers.run(thrown.size(), [&](std::size_t k) {
        thrown[k] = 1;
        throw k;
      });
      FAIL();
    } catch (std::size_t k) {
      for (std::size_t before = 0; before < k; ++before) EXPECT_EQ(thrown[before], 0);
      EXPECT_EQ(thrown[k], 1);
    }
  }
}

TEST(Workers, NoJobsWithinJobs) {
  for (const int threads : numbers_of_threads) {
    Workers workers(threads);
    EXPECT_THROW(workers.run(8, [&](std::size_t) { workers.run(2, [](std::size_t) {}); }), std::logic_error);
    EXPECT_THROW(workers.run(8, [&](std::size_t) { Workers::none().run(1, [](std::size_t) {}); }), std::logic_error);
    int done = 0;
    workers.run(1, [&](std::size_t) { ++done; });
    EXPECT_EQ(done, 1);
  }
}

/// After pauses, in which the threads fall asleep, and after a job that takes far longer than any other.
TEST(Workers, AfterPausesAndLongJobs) {
  Workers workers(3);
  std::atomic<int> done = 0;
  for (int round = 0; round < 20; ++round) {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    workers.run(6, [&](std::size_t k) {
      if (k == 2) std::this_thread::sleep_for(std::chrono::microseconds(300));
      ++done;
    });
  }
  EXPECT_EQ(done, 120);
}

TEST(Workers, OneCallerEach) {
  std::vector<std::thread> callers;
  std::atomic<int> done = 0;
  for (int c = 0; c < 3; ++c)
    callers.emplace_back([&] {
      Workers own(2);
      for (int task = 0; task < 200; ++task) {
        own.run(3, [&](std::size_t) { ++done; });
        Workers::none().run(3, [&](std::size_t) { ++done; });
      }
    });
  for (auto& caller : callers) caller.join();
  EXPECT_EQ(done, 3 * 200 * 6);
}

TEST(Workers, AtLeastOne) {
  expect_refused([] { const Workers workers(0); }, "threads: 0");
  expect_refused([] { const Workers workers(-3); }, "threads: -3");
  EXPECT_GE(Workers::all_cores(), 1);
}

}  // namespace
}  // namespace cutbench
