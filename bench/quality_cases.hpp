// Which cases `macula bench quality` runs, and how one of them runs.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/quality_reference.hpp"

namespace macula::bench {

// One method with its parameters.
struct QualityRequest {
    std::string method;                // of method::methods()
    std::uint32_t spp = 1;             // of full
    std::optional<QualityWeier> weier; // of weier; of lowres that which it equals
    std::string equal;                 // of lowres: samples or time

    std::string name() const; // for people
};

// All cases that the options ask for, full first. Throws std::invalid_argument.
std::vector<QualityRequest> quality_requests(const QualityOptions& options);

// One scene with one lighting.
class QualityGroup {
  public:
    // Flight and options must outlive it.
    QualityGroup(const QualityFlight& flight, const QualityOptions& options,
                 frame::LightMode lights, const QualityProgress& progress);

    // What the result will say besides its figures.
    report::QualityCase blank(const QualityRequest& request) const;
    report::QualityCase run(const QualityRequest& request);

  private:
    render::Renderer make(const QualityRequest& request, double scale) const;
    // lowres: as many samples as weier takes, or, from there, as much time.
    Sequence fly_equal(const QualityRequest& request, report::Parameters& parameters);
    Sequence fly_equal_time(const QualityRequest& request, report::Parameters& parameters);
    void score(report::QualityCase& result, const Sequence& sequence);

    const QualityFlight& flight_;
    const QualityOptions& options_;
    frame::LightMode lights_;
    const QualityProgress& progress_;
    References references_;
    std::map<std::string, double> weier_samples_; // a frame, by name
};

} // namespace macula::bench
