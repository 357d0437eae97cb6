#include "host/metric/flip.hpp"

#include "host/metric/flip_window.hpp"

namespace macula::metric {

ScalarMap flip(const Picture& reference, const Picture& test, double pixels_per_degree) {
    check_pair(reference, test);
    check_density(pixels_per_degree);
    ScalarMap errors(reference.width, reference.height);
    errors.values = flip_window(Opponent(reference), Opponent(test), pixels_per_degree,
                                {0, 0, reference.width, reference.height})
                        .values;
    return errors;
}

} // namespace macula::metric
