/* Evaluates the rules of selftest/rules.h over a table of inputs. */
#include "selftest/rules.h"

/* inputs: count triples. out: MACULA_RULES words for each. */
kernel void arithmetic(global const float* restrict inputs, global uint* restrict out,
                       const uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count)
        return;
    uint words[MACULA_RULES];
    evaluate_rules(inputs[3u * i], inputs[3u * i + 1u], inputs[3u * i + 2u], words);
    for (uint rule = 0u; rule < MACULA_RULES; ++rule)
        out[MACULA_RULES * i + rule] = words[rule];
}

/* Facts that no result may depend on, reported only: out[0] is a denormal product, 0 where the
 * device flushes; out[1] is the sum of the two zeros. */
kernel void facts(const float tiny, const float zero, global uint* restrict out) {
    out[0] = as_uint(tiny * 0.5f);
    out[1] = as_uint(zero + -zero);
}
