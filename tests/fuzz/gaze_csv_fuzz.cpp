// Gaze and head recordings: the canonical tables and every importer.
#include <stdexcept>

#include "fuzz.hpp"
#include "scenes/gaze/import.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace macula::scene;
    if (size == 0)
        return 0;
    const std::string text = fuzz::text_of(data + 1, size - 1);
    try {
        const std::vector<std::string> formats = trace_formats();
        const std::size_t choice = data[0] % (formats.size() + 3);
        if (choice == 0) {
            const GazePointer gaze = recorded_gaze(parse_gaze_csv(text, "fuzz.csv"), AtEnd::repeat);
            gaze->at(std::int64_t{1} << 40);
        } else if (choice == 1) {
            const RecordedHead head(parse_head_csv(text, "fuzz.csv"));
            head.on({}, std::int64_t{1} << 40, 1.0);
        } else {
            import_trace(text, "fuzz.csv", choice == 2 ? "" : formats[choice - 3]);
        }
    } catch (const SceneError&) {
    }
    return 0;
}
