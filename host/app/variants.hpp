// What this device would trace with: the table of `macula variants` and `render --list-variants`.
#pragma once

namespace macula::compute {
class Device;
}

namespace macula::app {

// The registry on standard output, with what is chosen on `device` (tuned, or the defaults) and why
// a variant does not apply; what is wrong with the tuning file goes to standard error.
void print_variants(const compute::Device& device);

// One line on standard error for each thing that is wrong with the tuning file that `device` uses.
void print_tuning_warnings(const compute::Device& device);

} // namespace macula::app
