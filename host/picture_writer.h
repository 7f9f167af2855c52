/// A picture's file, written as the rows come: memory holds a few rows of it and not the whole.
#pragma once

#include "host/picture_file.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

namespace clucida::host {

/// Takes bytes of the file and where in it they go. In order, but that a float map begins with its last rows.
using PutBytes = std::function<void(std::uint64_t offset, std::string_view bytes)>;

class PictureWriter {
public:
    /// @throws UsageError as require_encodable
    PictureWriter(unsigned width, unsigned height, FileFormat format, const EncodeOptions& options, PutBytes put);
    ~PictureWriter();
    PictureWriter(const PictureWriter&) = delete;
    PictureWriter& operator=(const PictureWriter&) = delete;

    /// The next rows from the top, whole ones, as in a Picture. Of a JPEG, whose encoder wants all of it at once, three
    /// bytes a pixel are kept.
    void add(std::span<const float> rgb);
    /// After the last row. @throws Failure if the encoder fails
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace clucida::host
