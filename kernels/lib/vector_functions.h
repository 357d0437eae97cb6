/* Three-vectors whose components have one width: included once for each, with MACULA_WIDTH set to
 * it, VECTOR3 to the type and VECTOR_MASK to that of a condition. No include guard. */
#define REAL MACULA_OF_WIDTH(float)

MACULA_OVERLOADED VECTOR3 make3(REAL x, REAL y, REAL z) {
    const VECTOR3 v = {x, y, z};
    return v;
}
MACULA_OVERLOADED VECTOR3 add3(VECTOR3 a, VECTOR3 b) {
    return make3(a.x + b.x, a.y + b.y, a.z + b.z);
}
MACULA_OVERLOADED VECTOR3 sub3(VECTOR3 a, VECTOR3 b) {
    return make3(a.x - b.x, a.y - b.y, a.z - b.z);
}
MACULA_OVERLOADED VECTOR3 mul3(VECTOR3 a, VECTOR3 b) {
    return make3(a.x * b.x, a.y * b.y, a.z * b.z);
}
MACULA_OVERLOADED VECTOR3 scale3(VECTOR3 a, REAL s) {
    return make3(a.x * s, a.y * s, a.z * s);
}
MACULA_OVERLOADED VECTOR3 neg3(VECTOR3 a) {
    return make3(-a.x, -a.y, -a.z);
}
MACULA_OVERLOADED VECTOR3 fma3(VECTOR3 a, VECTOR3 b, VECTOR3 c) {
    return make3(fma(a.x, b.x, c.x), fma(a.y, b.y, c.y), fma(a.z, b.z, c.z));
}
/* a where the condition holds, else b. */
MACULA_OVERLOADED VECTOR3 select3(VECTOR_MASK condition, VECTOR3 a, VECTOR3 b) {
    return make3(condition ? a.x : b.x, condition ? a.y : b.y, condition ? a.z : b.z);
}
MACULA_OVERLOADED VECTOR3 splat3(REAL s) {
    return make3(s, s, s);
}
/* v * s + c, one rounding. */
MACULA_OVERLOADED VECTOR3 scale_add3(VECTOR3 v, REAL s, VECTOR3 c) {
    return fma3(v, splat3(s), c);
}
MACULA_OVERLOADED VECTOR3 lerp3(VECTOR3 a, VECTOR3 b, REAL t) {
    return scale_add3(sub3(b, a), t, a);
}
MACULA_OVERLOADED REAL dot3(VECTOR3 a, VECTOR3 b) {
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
MACULA_OVERLOADED VECTOR3 cross3(VECTOR3 a, VECTOR3 b) {
    return make3(fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)),
                 fma(a.x, b.y, -(a.y * b.x)));
}
MACULA_OVERLOADED REAL largest3(VECTOR3 a) {
    return m_max(m_max(fabs(a.x), fabs(a.y)), fabs(a.z));
}

/* v scaled to unit length; `fallback` where v is zero or too small to have a direction. Components
 * are scaled first, so that no square underflows or overflows. */
MACULA_OVERLOADED VECTOR3 unit3(VECTOR3 v, VECTOR3 fallback) {
    const REAL size = largest3(v);
    const VECTOR_MASK large = size > (REAL)(1e-30f);
    const VECTOR3 w = scale3(v, m_divide((REAL)(1.0f), large ? size : (REAL)(1.0f)));
    const REAL squared = dot3(w, w);
    return select3(large, scale3(w, m_inverse_sqrt(squared)), fallback);
}

#undef REAL
