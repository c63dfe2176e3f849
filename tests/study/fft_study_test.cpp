// Protects: the study holds every method against the same sums, so its errors are those of the types.
#include <gtest/gtest.h>

#include "bn/error.h"
#include "bn_study/fft.h"

namespace bn {
namespace {

TEST(FftStudy, ErrorsAreThoseOfTheTypes) {
  const auto rows = study_fft({64, 61});
  ASSERT_EQ(rows.size(), 6u);
  for (const FftStudyRow& row : rows) {
    EXPECT_GT(row.relative_error, 0.0);
    EXPECT_LT(row.relative_error, row.type == "double" ? 1e-15 : 1e-6) << row.method << " " << row.side;
  }
  EXPECT_THROW(study_fft({1}), Error);
}

}  // namespace
}  // namespace bn
