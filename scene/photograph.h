/// Photographs: whatever stb_image reads, as packed texels.
#pragma once

#include "scene/model.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace clucida::scene {

struct Texels {
    unsigned width = 0, height = 0;
    std::vector<std::uint32_t> rgb; ///< 0x00BBGGRR, rows from the top
};

/// @throws Error at photograph.at if the file is missing, no picture, or larger than 16384 on a side
Texels load_photograph(const Photograph& photograph);

/// Photographs that several frames need are read once. Of use to several threads at a time.
class PhotographCache {
public:
    /// @throws Error as load_photograph
    std::shared_ptr<const Texels> load(const Photograph& photograph);

private:
    std::mutex mutex_;
    std::map<std::string, std::shared_ptr<const Texels>> known_; ///< by file
};

} // namespace clucida::scene
