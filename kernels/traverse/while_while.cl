/* Aila and Laine 2009, "Understanding the Efficiency of Ray Traversal on GPUs", section 4:
 * while-while. The reference of the variants. */
#include "lib/traverse_while_while.h"

#include "lib/traverse_one_ray.h"
