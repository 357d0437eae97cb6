/* The functions of lib/random.h for lanes of one width: included once for each, with MACULA_WIDTH
 * set to it. No include guard. */
#define REAL MACULA_OF_WIDTH(float)
#define UINT MACULA_OF_WIDTH(uint)

/* Wellons' `lowbias32`: a bijection of 32 bits with a near-ideal avalanche. */
MACULA_OVERLOADED UINT random_mix(UINT x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

/* What the numbers of one pixel and frame have in common; computed once by a work-item. */
MACULA_OVERLOADED UINT random_key(UINT pixel, uint frame, uint seed) {
    return random_mix(pixel + (UINT)random_mix(frame + random_mix(seed ^ 0x9e3779b9u)));
}

MACULA_OVERLOADED UINT random_bits(UINT key, UINT sample, uint dimension) {
    return random_mix(key ^ random_mix(sample * 0x9e3779b1u + dimension * 0x85ebca77u));
}

/* Uniform in [0, 1), a multiple of 2^-24. */
MACULA_OVERLOADED REAL random_unit(UINT key, UINT sample, uint dimension) {
    return MACULA_OF_WIDTH(convert_float)(random_bits(key, sample, dimension) >> 8) * 0x1p-24f;
}

#undef REAL
#undef UINT
