#include "host/frame/graph.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace macula::frame {

Graph::Graph(std::string name, std::string purpose)
    : name_(std::move(name)), purpose_(std::move(purpose)) {}

void Graph::rename(std::string name, std::string purpose) {
    name_ = std::move(name);
    purpose_ = std::move(purpose);
}

Graph& Graph::add(Stage stage) {
    append(std::move(stage), 0, 1);
    return *this;
}

Graph& Graph::for_each_sample(std::vector<Stage> stages, std::uint32_t at_least) {
    ++groups_;
    for (Stage& stage : stages)
        append(std::move(stage), groups_, at_least);
    return *this;
}

void Graph::append(Stage stage, int group, std::uint32_t at_least) {
    for (const std::string& resource : stage.reads) {
        if (!writer_.contains(resource))
            throw GraphError(fmt::format("method {}: stage \"{}\" reads \"{}\" before any stage "
                                         "has written it",
                                         name_, stage.name, resource));
        if (holds_[place_[resource]] != resource)
            throw GraphError(fmt::format("method {}: stage \"{}\" reads \"{}\" after \"{}\" has "
                                         "taken its storage",
                                         name_, stage.name, resource, holds_[place_[resource]]));
    }
    for (const Resource& resource : stage.writes) {
        const auto [place, is_new] = writer_.try_emplace(resource.name, nodes_.size());
        if (!is_new)
            throw GraphError(fmt::format(
                "method {}: stage \"{}\" writes \"{}\", which stage \"{}\" writes already", name_,
                stage.name, resource.name,
                place->second < nodes_.size() ? nodes_[place->second].stage.name : stage.name));
        place_[resource.name] = resource.place();
        holds_[resource.place()] = resource.name;
    }
    nodes_.push_back({std::move(stage), at_least, group, false, {}});
}

std::vector<std::string> Graph::resources() const {
    std::vector<std::string> names;
    for (const auto& [name, writer] : writer_)
        names.push_back(name);
    return names;
}

const Graph::Node* Graph::writer_of(const std::string& resource) const {
    const auto found = writer_.find(resource);
    return found == writer_.end() ? nullptr : &nodes_[found->second];
}

// Last frame's contents are kept by exchanging buffers.
void Graph::require_own_storage(const std::string& reader, const std::string& resource) const {
    for (const auto& [name, place] : place_)
        if (name != resource && place == place_.at(resource))
            throw GraphError(fmt::format("method {}: stage \"{}\" reads the last frame's \"{}\", "
                                         "whose storage \"{}\" uses as well",
                                         name_, reader, resource, name));
}

// Backwards from the outputs; once more for every history that turns out to be read.
void Graph::mark_needed(const std::set<std::string>& outputs) {
    std::vector<std::string> open(outputs.begin(), outputs.end());
    while (!open.empty()) {
        const std::string name = open.back();
        open.pop_back();
        if (!needed_.insert(name).second)
            continue;
        Node& node = nodes_[writer_.at(name)];
        if (node.needed)
            continue;
        node.needed = true;
        open.insert(open.end(), node.stage.reads.begin(), node.stage.reads.end());
        for (const std::string& past : node.stage.reads_last) {
            if (!writer_of(past))
                throw GraphError(fmt::format("method {}: stage \"{}\" reads the last frame's "
                                             "\"{}\", which no stage writes",
                                             name_, node.stage.name, past));
            require_own_storage(node.stage.name, past);
            history_.insert(past);
            open.push_back(past);
        }
    }
}

void Graph::allocate(compute::Device& device) {
    resources_ = std::make_unique<Resources>(device);
    for (const Node& node : nodes_) {
        if (!node.needed)
            continue;
        for (const Resource& resource : node.stage.writes) {
            if (needed_.contains(resource.name))
                resources_->allocate(resource);
            if (history_.contains(resource.name))
                resources_->keep_history(resource);
        }
        for (const Resource& resource : node.stage.scratch)
            resources_->reserve_scratch(resource);
    }
    resources_->allocate_scratch();
}

void Graph::compile(compute::Device& device, const std::set<std::string>& outputs) {
    if (resources_)
        throw GraphError("method " + name_ + " is compiled already");
    for (const std::string& output : outputs) {
        if (!writer_of(output))
            throw GraphError(fmt::format("method {} has no output \"{}\"; it has {}", name_, output,
                                         fmt::join(resources(), ", ")));
    }
    mark_needed(outputs);
    allocate(device);
    for (Node& node : nodes_) {
        if (node.needed)
            node.body = node.stage.prepare();
    }
}

std::string Graph::explain() const {
    std::string text = fmt::format("{}: {}\n", name_, purpose_);
    int group = 0;
    for (const Node& node : nodes_) {
        if (node.group != 0 && node.group != group)
            text += "  for each pixel sample:\n";
        group = node.group;
        const std::string indent(group != 0 ? 4 : 2, ' ');
        const bool left_out = resources_ && !node.needed;
        text += fmt::format("{}{}{}\n", indent, node.stage.name,
                            left_out ? " (left out: nobody reads it)" : "");
        std::vector<std::string> reads = node.stage.reads;
        for (const std::string& past : node.stage.reads_last)
            reads.push_back("last frame's " + past);
        if (!reads.empty())
            text += fmt::format("{}    reads  {}\n", indent, fmt::join(reads, ", "));
        std::vector<std::string> writes;
        for (const Resource& resource : node.stage.writes) {
            const bool unread = resources_ && !left_out && !needed_.contains(resource.name);
            writes.push_back(unread ? "(" + resource.name + ")" : resource.name);
        }
        text += fmt::format("{}    writes {}\n", indent, fmt::join(writes, ", "));
    }
    return text;
}

void Graph::run_group(std::size_t first, std::size_t last, const shared::FrameParams& params) {
    const bool repeated = nodes_[first].group != 0;
    const std::uint32_t samples =
        repeated ? std::max(params.samples_per_pixel, nodes_[first].at_least) : 1u;
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
        Run run(params, *resources_, sample);
        for (std::size_t i = first; i < last; ++i) {
            if (nodes_[i].needed)
                nodes_[i].body(run);
        }
    }
}

void Graph::execute(const shared::FrameParams& params) {
    if (!resources_)
        throw GraphError("method " + name_ + " is not compiled");
    resources_->advance();
    resources_->set_params(params);
    for (std::size_t first = 0; first < nodes_.size();) {
        std::size_t last = first + 1;
        while (last < nodes_.size() && nodes_[last].group == nodes_[first].group)
            ++last;
        run_group(first, last, params);
        first = last;
    }
    resources_->end_first_frame();
}

const compute::Buffer& Graph::result(const std::string& name) const {
    if (!resources_)
        throw GraphError("method " + name_ + " is not compiled");
    return resources_->current(name);
}

void Graph::forget() {
    if (resources_)
        resources_->clear_history();
}

} // namespace macula::frame
