#include "compare/study/limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace surge::compare {
namespace {

using nlohmann::json;

/// Two runs beside a reference; the front of "late" reaches its levels after the reference.
json measured() {
  return {{"definition", {{"reference", "vof"}}},
          {"front",
           {{"vof", {{"rms_vs_vof", 0.0}}},
            {"late",
             {{"rms_vs_vof", 0.03},
              {"max_vs_vof", 0.05},
              {"max_at_T", 1.5},
              {"bias_vs_vof", -0.02},
              {"arrival_T_difference", {{"1.5", 0.02}, {"2.0", -0.06}, {"2.5", nullptr}}}}},
            {"never", {{"rms_vs_vof", nullptr}, {"arrival_T_difference", json::object()}}}}}};
}

TEST(Limits, TheArrivalIsThatOfTheLevelWhereItIsLargest) {
  for (const double limit : {0.07, 0.05}) {
    Limits limits;
    limits.arrival = {{"late", limit}};
    const auto reports = check_limits(measured(), limits);
    ASSERT_EQ(reports.size(), 1U);
    ASSERT_EQ(reports[0].findings.size(), 1U);
    const Finding& finding = reports[0].findings[0];
    EXPECT_EQ(finding.worst, "Z/L = 2.0");
    EXPECT_EQ(finding.deviation, -0.06);
    EXPECT_EQ(finding.status, limit > 0.06 ? Status::passed : Status::failed);
  }
}

TEST(Limits, WhatIsNotThereHasFailed) {
  Limits limits;
  limits.rms = limits.arrival = {{"", 1.0}};
  const auto reports = check_limits(measured(), limits);
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_TRUE(reports[0].passed());
  for (const Finding& finding : reports[1].findings) {
    EXPECT_EQ(finding.status, Status::failed);
    EXPECT_EQ(finding.found, "missing");
  }
}

}  // namespace
}  // namespace surge::compare
