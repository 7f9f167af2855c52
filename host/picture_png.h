/// PNG (ISO/IEC 15948): 8 and 16 bit RGB with text chunks. stb_image_write has neither 16 bits nor text.
#pragma once

#include "host/picture_file.h"

#include <memory>
#include <string>
#include <string_view>

namespace clucida::host {

/// Makes the file's bytes in order, as its rows come.
class PngEncoder {
public:
    PngEncoder(unsigned width, unsigned height, const EncodeOptions& options);
    ~PngEncoder();
    PngEncoder(const PngEncoder&) = delete;
    PngEncoder& operator=(const PngEncoder&) = delete;

    /// Rows of samples of options.depth bits (16: most significant byte first). @throws Failure
    void add(std::string_view samples);
    /// What has been made since it was asked last.
    std::string take();
    /// The rest of the file. @throws Failure
    std::string finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace clucida::host
