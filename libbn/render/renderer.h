// What the two renderers share.
#pragma once

#include "bn/render.h"

namespace bn::render {

/// Throws invalid_input unless the three fit; returns the extent of the seed image.
Extent check_rendering(const Scene& scene, const TemporalTextures& textures, const RenderSettings& settings);

/// The seeds a sequence starts with.
Seeds seeds_of_sequence(Extent padded, std::uint64_t seed);

/// Throws verification_failed unless the multiset of `seeds` is the one `digest` was made of.
void check_seeds(const Seeds& seeds, std::uint64_t digest);

}  // namespace bn::render
