// Animations of a glTF document as key frames. Internal to the glTF loader.
#pragma once

#include <map>
#include <string>

#include "scenes/gltf_document.hpp"
#include "scenes/load.hpp"
#include "scenes/motion.hpp"

namespace macula::scene {

class GltfAnimation {
  public:
    // Reads the animation that the options choose, if there is one. Throws SceneError on anything
    // out of range and on key frames that make no sense.
    GltfAnimation(const GltfDocument& document, const LoadOptions& options);

    bool moves(int node) const { return tracks_.contains(node); }
    // The pose of any node at rest, and the keys of one that moves.
    MotionNode node(int index) const;
    // Of the last key.
    float last_frame() const { return last_frame_; }
    // Animations that the document has beside the chosen one.
    std::size_t left_out() const { return left_out_; }
    bool has_weights() const { return has_weights_; } // of morph targets, which are ignored

  private:
    void read(const tinygltf::Animation& animation, const std::string& where);
    void read_channel(const tinygltf::Animation& animation,
                      const tinygltf::AnimationChannel& channel, const std::string& where);
    std::vector<float> frames(int accessor, const std::string& where);
    template <typename T>
    void read_track(const tinygltf::AnimationSampler& sampler, const std::string& where,
                    Track<T>& track);

    const GltfDocument& document_;
    float frame_rate_;
    std::map<int, MotionNode> tracks_; // by node: its keys alone
    float last_frame_ = 0.0f;
    std::size_t left_out_ = 0, keys_ = 0;
    bool has_weights_ = false;
};

} // namespace macula::scene
