// A frame as data: a method is a list of stages with English names that say which named resources
// they read and write. The graph checks the list, leaves out what nobody reads, and runs the rest.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "host/frame/resources.hpp"
#include "shared/camera.h"

namespace macula::frame {

// What a stage sees while it runs.
class Run {
  public:
    Run(const shared::FrameParams& params, Resources& resources, std::uint32_t sample)
        : params_(params), resources_(resources), sample_(sample) {}

    const shared::FrameParams& params() const { return params_; }
    // Pixel sample being rendered, < samples_per_pixel; 0 outside of for_each_sample.
    std::uint32_t sample() const { return sample_; }
    // True until a frame has been rendered since the beginning or the last forget().
    bool first_frame() const { return resources_.first_frame(); }
    // The frame parameters on the device.
    compute::Buffer& params_buffer() { return resources_.params(); }
    // Empty (a null pointer to a kernel) when nobody reads the resource.
    compute::Buffer& operator[](const std::string& name) { return resources_.current(name); }
    // Last frame's; zeros in the first frame.
    compute::Buffer& last(const std::string& name) { return resources_.last(name); }
    compute::Buffer& scratch(const std::string& name) { return resources_.scratch(name); }

  private:
    const shared::FrameParams& params_;
    Resources& resources_;
    std::uint32_t sample_;
};

using StageBody = std::function<void(Run&)>;

struct Stage {
    std::string name; // English, as in the paper's figure
    std::vector<std::string> reads;
    std::vector<std::string> reads_last; // of the last frame: history
    std::vector<Resource> writes;
    // Buffers whose contents nobody else needs; stages that name the same one share it.
    std::vector<Resource> scratch;
    // Builds what the stage needs on the device. Called once, and only if the stage is needed.
    std::function<StageBody()> prepare;
};

// A list that breaks the rules; the message names stages and resources.
class GraphError : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

class Graph {
  public:
    Graph(std::string name, std::string purpose);

    // Stages run in the order in which they are added. Throws GraphError when a stage reads what no
    // earlier stage writes, or what has given its storage to another resource since, or writes what
    // another one writes.
    Graph& add(Stage stage);
    // Stages that run one after another for each pixel sample, `at_least` times.
    Graph& for_each_sample(std::vector<Stage> stages, std::uint32_t at_least = 1);

    // For methods that are another one with further stages.
    void rename(std::string name, std::string purpose);
    const std::string& name() const { return name_; }
    const std::string& purpose() const { return purpose_; }
    // Names of all resources that some stage writes.
    std::vector<std::string> resources() const;

    // Decides what is computed so that `outputs` are there after a frame, drops the rest, allocates
    // and prepares. Throws GraphError for an output or a history that nobody writes. Call once.
    void compile(compute::Device& device, const std::set<std::string>& outputs);

    // The list in words, in order: what each stage reads and writes, what is left out.
    std::string explain() const;

    // Enqueues one frame. Nothing waits.
    void execute(const shared::FrameParams& params);
    // A resource of the last frame that was executed; empty when it was not computed.
    const compute::Buffer& result(const std::string& name) const;
    // Drops the history: the next frame is a first one.
    void forget();
    // Frames depend on those before. After compile().
    bool has_history() const { return !history_.empty(); }

  private:
    struct Node {
        Stage stage;
        std::uint32_t at_least = 1; // times, of a group
        int group = 0;              // equal for stages of one for_each_sample; 0: once a frame
        bool needed = false;
        StageBody body;
    };

    void append(Stage stage, int group, std::uint32_t at_least);
    const Node* writer_of(const std::string& resource) const;
    void require_own_storage(const std::string& reader, const std::string& resource) const;
    void mark_needed(const std::set<std::string>& outputs);
    void allocate(compute::Device& device);
    void run_group(std::size_t first, std::size_t last, const shared::FrameParams& params);

    std::string name_, purpose_;
    std::vector<Node> nodes_;
    std::map<std::string, std::size_t> writer_; // resource -> node
    std::map<std::string, std::string> place_;  // resource -> storage
    std::map<std::string, std::string> holds_;  // storage -> resource that was written last
    std::set<std::string> needed_;
    std::set<std::string> history_; // needed resources of which the last frame's are read
    std::unique_ptr<Resources> resources_;
    int groups_ = 0;
};

} // namespace macula::frame
