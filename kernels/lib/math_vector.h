/* lib/math.h for eight and sixteen lanes: the same bits in every lane as the scalar functions. */
#ifndef MACULA_LIB_MATH_VECTOR_H
#define MACULA_LIB_MATH_VECTOR_H

#include "lib/math.h"

#define MACULA_WIDTH 8
#include "lib/math_functions.h"
#undef MACULA_WIDTH
#define MACULA_WIDTH 16
#include "lib/math_functions.h"
#undef MACULA_WIDTH

#endif
