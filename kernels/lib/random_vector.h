/* lib/random.h for sixteen lanes: the same numbers in every lane as the scalar functions'. */
#ifndef MACULA_LIB_RANDOM_VECTOR_H
#define MACULA_LIB_RANDOM_VECTOR_H

#include "lib/random.h"

#define MACULA_WIDTH 16
#include "lib/random_functions.h"
#undef MACULA_WIDTH

#endif
