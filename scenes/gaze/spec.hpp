// Gaze as one writes it: `--gaze SPEC` and `--tracker LIST`. docs/gaze.md gives the syntax.
#pragma once

#include <string>

#include "scenes/gaze/models.hpp"
#include "scenes/gaze/tracker.hpp"

namespace macula::scene {

// What a source may refer to.
struct GazeContext {
    const Display& display;
    Eye eye = Eye::mono; // whose pixels `pixel:X,Y` names
    DepthFunction depth; // of a moving target; may be empty
};

// X,Y | centre | pixel:X,Y | target[:key=value,...] | synthetic[:key=value,...] |
// FILE.csv[:repeat] | trace:FILE[:repeat] | udp:PORT. Throws std::invalid_argument that names the
// part that is wrong, SceneError for a file's content.
GazePointer parse_gaze(const std::string& spec, const GazeContext& context);

// latency=MS,rate=HZ,noise=DEG,quantum=DEG,dropout=P,dropout-ms=MS,smooth=MS,saccade=DEG,
// widen=FACTOR,seed=N, each optional. Throws std::invalid_argument.
TrackerOptions parse_tracker(const std::string& list);

} // namespace macula::scene
