/* Makes 32x32x32 samples of noise, as a renderer would before its first frame, and says how long that took. */

#include <stdio.h>
#include <time.h>

#include "start_up_noise.h"

enum { kSide = 32, kDepth = 32, kLevels = 256 };

static double milliseconds(void) {
  struct timespec now;
  timespec_get(&now, TIME_UTC);
  return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

int main(void) {
  static uint8_t samples[kDepth * kSide * kSide];
  char problem[256] = "";
  const double begin = milliseconds();
  if (start_up_noise(samples, sizeof samples, kSide, kSide, kDepth, 1, problem, sizeof problem) != 0) {
    fprintf(stderr, "start_up: %s\n", problem);
    return 1;
  }
  const double taken = milliseconds() - begin;

  /* What a renderer relies on: each frame has every level equally often. */
  for (int frame = 0; frame < kDepth; ++frame) {
    int count[kLevels] = {0};
    for (int i = 0; i < kSide * kSide; ++i) ++count[samples[frame * kSide * kSide + i]];
    for (int level = 0; level < kLevels; ++level) {
      if (count[level] != kSide * kSide / kLevels) {
        fprintf(stderr, "start_up: level %d is %d times in frame %d\n", level, count[level], frame);
        return 1;
      }
    }
  }
  printf("%dx%dx%d samples of noise in %.1f ms\n", kSide, kSide, kDepth, taken);
  return 0;
}
