// bn_offsets.hlsl - one mask in many frames and with an importance map. Paste into your engine.
// The text of bn_offsets.glsl is HLSL as it stands; its comments say how it works.

#ifndef BN_OFFSETS_HLSL
#define BN_OFFSETS_HLSL

#include "bn_offsets.glsl"

#endif
