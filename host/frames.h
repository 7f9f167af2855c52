/// Which frames of a sequence are to be rendered, and the names of their files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clucida::host {

/// A list such as "1-10,20-100x5,7": frames, first to last (".." for "-" too; the last may be the lesser), every so
/// many-th. What is named twice is rendered once, where it is named first; *repeated tells how many that were.
/// @throws UsageError naming the part that is wrong
std::vector<unsigned> parse_frames(std::string_view list, unsigned* repeated = nullptr);

/// Of frames that several machines share the I-th machine's of N: every N-th. "I/N", 1 <= I <= N.
/// @throws UsageError
struct Shard {
    unsigned index = 1, count = 1;
};
Shard parse_shard(std::string_view text);
std::vector<unsigned> shard_of(const std::vector<unsigned>& frames, Shard shard);

/// A file's name for each frame: with "%d", "%04d" or a run of '#' for the number; "%%" stands for '%'.
class FramePattern {
public:
    FramePattern() = default;
    /// @throws UsageError for any other '%', or more than one place for the number
    explicit FramePattern(const std::string& pattern);

    bool has_number() const { return width_ >= 0; }
    std::string file(unsigned frame) const;

private:
    std::string before_, after_;
    int width_ = -1; ///< least digits; below 0 if there is no place for a number
};

} // namespace clucida::host
