#include <cmath>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/report/quality_case.hpp"

namespace macula::report {
namespace {

using Json = nlohmann::ordered_json;

// One description of every struct serves writing and reading: a visitor is called with each field.

struct Writer {
    Json& json;

    template <class T>
    void operator()(const char* name, const T& value) {
        json[name] = of(value);
    }

    template <class T>
    static Json of(const T& value);
};

// Where a field is, for messages: "scores.flip.mean".
struct Reader {
    const Json& json;
    std::string path;

    [[noreturn]] void fail(const std::string& name, const std::string& what) const {
        throw std::invalid_argument(fmt::format("field \"{}{}\" {}", path, name, what));
    }
    template <class T>
    void operator()(const char* name, T& value) const {
        const auto found = json.find(name);
        if (found == json.end())
            fail(name, "is missing");
        read(*found, name, value);
    }
    template <class T>
    void read(const Json& from, const std::string& name, T& value) const;
};

template <class Visitor, class T>
void visit_percentiles(Visitor& v, T& p) {
    v("median", p.median);
    v("p95", p.p95);
    v("p99", p.p99);
}

template <class T, class Visitor>
void visit(Visitor& v, T& r) {
    using Type = std::remove_const_t<T>;
    if constexpr (std::is_same_v<Type, Percentiles>) {
        visit_percentiles(v, r);
    } else if constexpr (std::is_same_v<Type, StageRow>) {
        v("stage", r.stage);
        v("launches", r.launches);
        visit_percentiles(v, r.ms);
    } else if constexpr (std::is_same_v<Type, Errors>) {
        v("mean", r.mean);
        v("weighted_median", r.weighted_median);
        v("q1", r.q1);
        v("q3", r.q3);
        v("max", r.max);
    } else if constexpr (std::is_same_v<Type, Scores>) {
        v("flip", r.flip);
        v("foveated_flip", r.foveated_flip);
        v("psnr", r.psnr);
        v("ssim", r.ssim);
        v("flicker_energy", r.flicker_energy);
        v("instability", r.instability);
    } else if constexpr (std::is_same_v<Type, AgainstFull>) {
        v("flip", r.flip);
        v("r0", r.r0);
        v("flip_inside_r0", r.flip_inside_r0);
    } else if constexpr (std::is_same_v<Type, Band>) {
        v("name", r.name);
        v("from", r.from);
        v("to", r.to);
        v("part", r.part);
        v("flip", r.flip);
        v("flicker_energy", r.flicker_energy);
        v("instability", r.instability);
    } else if constexpr (std::is_same_v<Type, Curve>) {
        v("degrees", r.degrees);
        v("flip", r.flip);
    } else if constexpr (std::is_same_v<Type, Series>) {
        v("frame", r.frame);
        v("ms", r.ms);
        v("flip", r.flip);
        v("foveated_flip", r.foveated_flip);
        v("flicker_energy", r.flicker_energy);
        v("instability", r.instability);
    } else if constexpr (std::is_same_v<Type, Picture>) {
        v("frame", r.frame);
        v("gaze", r.gaze);
        v("reference", r.reference);
        v("test", r.test);
        v("heat_map", r.heat_map);
    } else if constexpr (std::is_same_v<Type, View>) {
        v("tan_left", r.tan_left);
        v("tan_right", r.tan_right);
        v("tan_up", r.tan_up);
        v("tan_down", r.tan_down);
    } else {
        static_assert(std::is_same_v<Type, Parameters>);
        v("spp", r.spp);
        v("frc", r.frc);
        v("r0", r.r0);
        v("r1", r.r1);
        v("p_min", r.p_min);
        v("changes", r.changes);
        v("scale", r.scale);
        v("equal", r.equal);
        v("equal_to", r.equal_to);
        v("time_ratio", r.time_ratio);
    }
}

// What was asked for.
template <class Visitor, class T>
void visit_request(Visitor& v, T& r) {
    v("scene", r.scene);
    v("lights", r.lights);
    v("method", r.method);
    v("case", r.name);
    v("width", r.width);
    v("height", r.height);
    v("frames", r.frames);
    v("segments", r.segments);
    v("warm_up", r.warm_up);
    v("reference_spp", r.reference_spp);
    v("seed", r.seed);
    v("light_samples", r.light_samples);
    v("ambient_occlusion_samples", r.ambient_occlusion_samples);
    v("display", r.display);
    v("gaze", r.gaze);
    v("head", r.head);
    v("device", r.device);
}

template <class Visitor, class T>
void visit_case(Visitor& v, T& r) {
    visit_request(v, r);
    v("parameters", r.parameters);
    v("view", r.view);
    v("pixels_per_degree", r.pixels_per_degree);
    v("driver", r.driver);
    v("commit", r.commit);
    v("clock", r.clock);
    v("time_ms", r.time_ms);
    v("wall_ms", r.wall_ms);
    v("stages", r.stages);
    v("samples", r.samples);
    v("rays", r.rays);
    v("scores", r.scores);
    v("against_full", r.against_full);
    v("bands", r.bands);
    v("eccentricity", r.eccentricity);
    v("series", r.series);
    v("pictures", r.pictures);
}

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};

template <class T>
Json Writer::of(const T& value) {
    if constexpr (IsOptional<T>::value) {
        return value ? of(*value) : Json(nullptr);
    } else if constexpr (IsVector<T>::value) {
        Json list = Json::array();
        for (const auto& element : value)
            list.push_back(of(element));
        return list;
    } else if constexpr (std::is_floating_point_v<T>) {
        if (!std::isfinite(value))
            throw std::invalid_argument("a result that is not a finite number");
        return value;
    } else if constexpr (std::is_class_v<T> && !std::is_constructible_v<Json, T>) {
        Json object = Json::object();
        Writer inner{object};
        visit(inner, value);
        return object;
    } else {
        return value;
    }
}

template <class T>
void Reader::read(const Json& from, const std::string& name, T& value) const {
    if constexpr (IsOptional<T>::value) {
        value.reset();
        if (!from.is_null())
            read(from, name, value.emplace());
    } else if constexpr (IsVector<T>::value) {
        if (!from.is_array())
            fail(name, "is no list");
        value.clear();
        for (const Json& element : from) {
            const std::string place = fmt::format("{}[{}]", name, value.size());
            read(element, place, value.emplace_back());
        }
    } else if constexpr (std::is_same_v<T, std::array<double, 2>>) {
        if (!from.is_array() || from.size() != 2)
            fail(name, "is no pair of numbers");
        for (std::size_t i = 0; i < 2; ++i)
            read(from[i], fmt::format("{}[{}]", name, i), value[i]);
    } else if constexpr (std::is_same_v<T, std::string>) {
        if (!from.is_string())
            fail(name, "is no text");
        value = from.template get<std::string>();
    } else if constexpr (std::is_same_v<T, std::uint32_t>) {
        if (!from.is_number_unsigned() || from.template get<std::uint64_t>() > 0xffffffffu)
            fail(name, "is no whole number from 0 to 4294967295");
        value = from.template get<std::uint32_t>();
    } else if constexpr (std::is_same_v<T, double>) {
        if (!from.is_number())
            fail(name, "is no number");
        value = from.template get<double>();
    } else {
        if (!from.is_object())
            fail(name, "is no object");
        Reader inner{from, path + name + "."};
        visit(inner, value);
    }
}

void check(const QualityCase& r) {
    const auto refuse = [](const std::string& what) { throw std::invalid_argument(what); };
    if (r.width == 0 || r.height == 0 || r.width > 16384 || r.height > 16384)
        refuse("fields \"width\" and \"height\" must lie between 1 and 16384");
    const Series& s = r.series;
    if (s.ms.size() != s.frame.size() || s.flip.size() != s.frame.size() ||
        s.foveated_flip.size() != s.frame.size() || s.flicker_energy.size() != s.frame.size() ||
        s.instability.size() != s.frame.size())
        refuse("the lists in field \"series\" differ in length");
    if (r.eccentricity.degrees.size() != r.eccentricity.flip.size())
        refuse("the lists in field \"eccentricity\" differ in length");
}

} // namespace

std::string json_line(const QualityCase& result) {
    Json json{{"schema", kSchema}};
    Writer writer{json};
    visit_case(writer, result);
    return json.dump(-1, ' ', true);
}

QualityCase parse_case(const std::string& line) {
    Json json;
    try {
        json = Json::parse(line);
    } catch (const nlohmann::json::exception& error) {
        throw std::invalid_argument(error.what());
    }
    if (!json.is_object())
        throw std::invalid_argument("an object {...} was expected");
    const auto schema = json.find("schema");
    if (schema == json.end() || *schema != kSchema)
        throw std::invalid_argument(
            fmt::format("field \"schema\" is not {}: this is no result of `macula bench quality`, "
                        "or of another version of it",
                        kSchema));
    QualityCase result;
    Reader reader{json, ""};
    visit_case(reader, result);
    check(result);
    return result;
}

std::string identity(const QualityCase& result) {
    Json json = Json::object();
    Writer writer{json};
    visit_request(writer, result);
    Parameters asked = result.parameters;
    if (asked.equal) { // these are found, not asked for
        asked.scale.reset();
        asked.time_ratio.reset();
    }
    writer("parameters", asked);
    return json.dump(-1, ' ', true);
}

} // namespace macula::report
