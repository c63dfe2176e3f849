// bn_quantise.hlsl - the dither itself: from a real value to one of few codes. Paste into your engine.
// The text of bn_quantise.glsl is HLSL as it stands; its comments say how it works.

#ifndef BN_QUANTISE_HLSL
#define BN_QUANTISE_HLSL

#include "bn_quantise.glsl"

#endif
