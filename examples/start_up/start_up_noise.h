/* A spatiotemporal blue-noise mask, made in memory when a program starts. C99. */

#ifndef START_UP_NOISE_H
#define START_UP_NOISE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Makes `depth` slices of width x height samples of 8 bits, for a renderer that averages its frames (preset
   "both"). samples[(slice * height + y) * width + x]; each level is equally often in every slice where width *
   height is a multiple of 256. The same arguments give the same bytes on every machine. Sides 1..16384, `bytes`
   at least width * height * depth.
   Returns 0; or 1, with `samples` as they were and the reason in `problem`, ended by 0 and cut to fit. One
   thread. About 0.5 us a sample. */
int start_up_noise(uint8_t *samples, size_t bytes, int width, int height, int depth, uint64_t seed, char *problem,
                   size_t problem_bytes);

#ifdef __cplusplus
}
#endif

#endif
