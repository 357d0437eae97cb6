// What every loader throws: a message that names the file, the place in it and the cause.
#pragma once

#include <stdexcept>

namespace macula::scene {

class SceneError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

} // namespace macula::scene
