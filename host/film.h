/// Films: frames one after the other, as a stream that other programs read, or encoded by ffmpeg.
#pragma once

#include "host/tiling.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace clucida::host {

/// y4m: YUV4MPEG2, 4:4:4, BT.709 within 16..235. rgb: three bytes a pixel and nothing else. The others need ffmpeg:
/// H.264, VP9, an animated GIF, and mkv without loss (FFV1).
enum class FilmFormat { y4m, rgb, mp4, webm, gif, mkv };

/// By the ending of a file's name, or by the ending alone; whatever the case.
std::optional<FilmFormat> film_format(std::string_view name);

/// The endings there are, for messages.
std::string film_endings();

/// A frame rate as two whole numbers: 24000/1001 for 23.976.
struct Rate {
    unsigned frames = 24, seconds = 1;
};
Rate rate_of(double fps);

/// @throws UsageError if the format cannot hold frames of this size
void require_filmable(Shape size, FilmFormat format);

class Film {
public:
    /// file "-": standard output. @throws Failure if ffmpeg cannot be started
    Film(const std::string& file, FilmFormat format, Shape size, double fps);
    ~Film(); ///< what is not finished leaves no file
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// A frame, three bytes a pixel from the top. @throws Failure with what ffmpeg said, if it has ended
    void add(std::span<const std::uint8_t> rgb);
    /// After the last frame: the file appears. @throws Failure
    void finish();

private:
    struct Sink;
    struct Stream;
    struct Encoder;
    std::unique_ptr<Sink> sink_;
};

} // namespace clucida::host
