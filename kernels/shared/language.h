/* The dialect in which shared structs and scalar device functions are written once and compiled
 * twice: as OpenCL C 1.2 on the device and as C++20 on the host (namespace macula::shared).
 *
 * The arithmetic contract (docs/arithmetic.md): only + - *, explicit fma, integer operations,
 * compare and select, rint, floor, fabs, copysign. A product never feeds a sum without fma. */
#ifndef MACULA_SHARED_LANGUAGE_H
#define MACULA_SHARED_LANGUAGE_H

#ifdef __OPENCL_VERSION__

#pragma OPENCL FP_CONTRACT OFF
#define MACULA_SHARED_BEGIN
#define MACULA_SHARED_END
#define MACULA_GLOBAL global
#define MACULA_CONSTANT constant
#define MACULA_INLINE static inline
/* For functions that write through pointers to private variables in divergent code: Intel's CPU
 * vectoriser mixes up such variables when the function is not inlined (docs/arithmetic.md asks for
 * the same bits on every runtime). */
#define MACULA_ALWAYS_INLINE static inline __attribute__((always_inline))
/* For functions that exist for several widths of vectors. */
#define MACULA_OVERLOADED static inline __attribute__((overloadable, always_inline))
#define MACULA_ASSERT_SIZE(type, bytes)                                                            \
    typedef char macula_size_of_##type[(sizeof(type) == (bytes)) ? 1 : -1]

#else /* C++ */

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#define MACULA_SHARED_BEGIN namespace macula::shared {
#define MACULA_SHARED_END } /* namespace macula::shared */
#define MACULA_GLOBAL
#define MACULA_CONSTANT const
#define MACULA_INLINE inline
#define MACULA_ALWAYS_INLINE inline
#define MACULA_OVERLOADED inline
#define MACULA_ASSERT_SIZE(type, bytes) static_assert(sizeof(type) == (bytes))

namespace macula::shared {
using uint = std::uint32_t;
using ushort = std::uint16_t;
using uchar = std::uint8_t;
inline uint as_uint(float x) {
    return std::bit_cast<uint>(x);
}
inline int as_int(float x) {
    return std::bit_cast<int>(x);
}
inline int as_int(uint x) {
    return std::bit_cast<int>(x);
}
inline float as_float(uint x) {
    return std::bit_cast<float>(x);
}
inline float as_float(int x) {
    return std::bit_cast<float>(x);
}
inline float fma(float a, float b, float c) {
    return std::fma(a, b, c);
}
inline float rint(float x) {
    return std::nearbyintf(x);
}
inline float floor(float x) {
    return std::floor(x);
}
inline float fabs(float x) {
    return std::fabs(x);
}
inline float copysign(float x, float y) {
    return std::copysign(x, y);
}
inline int convert_int(float x) {
    return static_cast<int>(x);
}
inline float convert_float(int x) {
    return static_cast<float>(x);
}
inline float convert_float(uint x) {
    return static_cast<float>(x);
}
} // namespace macula::shared

#endif

/* MACULA_OF_WIDTH(float) is float, float8 or float16, by the macro MACULA_WIDTH: empty, 8 or 16. */
#define MACULA_JOIN_EXPANDED(a, b) a##b
#define MACULA_JOIN(a, b) MACULA_JOIN_EXPANDED(a, b)
#define MACULA_OF_WIDTH(name) MACULA_JOIN(name, MACULA_WIDTH)

#endif
