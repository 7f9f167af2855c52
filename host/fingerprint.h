/// What a picture is made of, as a digest that its file carries: whether a file is the picture that would be rendered.
#pragma once

#include "host/motion.h"
#include "host/picture_file.h"
#include "host/renderer.h"

#include <mutex>
#include <string>
#include <string_view>

namespace clucida::host {

/// Digests of frames. Of use to several threads at a time.
class Fingerprints {
public:
    /// The program's version, what the device is given, its precision, and how the picture is encoded; not the device.
    std::string of(const CompiledFrame& frame, Precision precision, StereoLayout layout, FileFormat format,
                   const EncodeOptions& encoding);

private:
    std::string of_texels(const scene::Bytes& texels);

    std::mutex mutex_;
    scene::Bytes last_texels_; ///< photographs, which are large and the same from frame to frame
    std::string last_digest_;
};

/// The fingerprint that a picture's bytes carry, or nothing.
std::string fingerprint_in(std::string_view bytes);

/// Whether the file is there, whole, and carries this fingerprint.
bool is_same_picture(const std::string& file, const std::string& fingerprint);

} // namespace clucida::host
