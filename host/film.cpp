#include "host/film.h"

#include "host/atomic_file.h"
#include "host/child_process.h"
#include "host/errors.h"
#include "host/file_ending.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numeric>
#include <sstream>
#include <utility>
#include <vector>

namespace clucida::host {
namespace {

constexpr FileEnding<FilmFormat> endings[] = {{"y4m", FilmFormat::y4m}, {"rgb", FilmFormat::rgb},
                                              {"mp4", FilmFormat::mp4}, {"webm", FilmFormat::webm},
                                              {"gif", FilmFormat::gif}, {"mkv", FilmFormat::mkv}};

/// Bytes of 8-bit RGB as planes Y, Cb, Cr (ITU-R BT.709, limited range).
std::string planes_of(std::span<const std::uint8_t> rgb)
{
    const std::size_t count = rgb.size() / 3;
    std::string out(rgb.size(), '\0');
    const auto byte = [](double x) { return static_cast<char>(static_cast<std::uint8_t>(std::lround(x))); };
    for (std::size_t i = 0; i < count; ++i) {
        const double r = rgb[3 * i] / 255.0, g = rgb[3 * i + 1] / 255.0, b = rgb[3 * i + 2] / 255.0;
        const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        out[i] = byte(16 + 219 * y);
        out[count + i] = byte(128 + 224 * (b - y) / 1.8556);
        out[2 * count + i] = byte(128 + 224 * (r - y) / 1.5748);
    }
    return out;
}

std::vector<std::string> words(std::string_view text)
{
    std::istringstream stream{std::string(text)};
    return {std::istream_iterator<std::string>(stream), {}};
}

std::vector<std::string> encoder_arguments(FilmFormat format)
{
    const std::string halved = "-vf scale=out_color_matrix=bt709:out_range=tv,format=yuv420p -colorspace bt709 "
                               "-color_primaries bt709 -color_trc iec61966-2-1 ";
    switch (format) {
    case FilmFormat::mp4: return words(halved + "-c:v libx264 -crf 17 -movflags +faststart -f mp4");
    case FilmFormat::webm: return words(halved + "-c:v libvpx-vp9 -crf 24 -b:v 0 -row-mt 1 -f webm");
    case FilmFormat::gif:
        return words("-filter_complex split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=bayer "
                     "-loop 0 -f gif");
    default: return words("-c:v ffv1 -pix_fmt gbrp -f matroska");
    }
}

bool is_streamed(FilmFormat format)
{
    return format == FilmFormat::y4m || format == FilmFormat::rgb;
}

} // namespace

std::optional<FilmFormat> film_format(std::string_view name)
{
    return format_of<FilmFormat>(name, endings);
}

std::string film_endings()
{
    return listed<FilmFormat>(endings);
}

Rate rate_of(double fps)
{
    // Television's rates are whole ones by 1000/1001.
    const double whole = std::round(fps * 1.001);
    if (fps != std::round(fps) && std::fabs(whole / 1.001 - fps) < 1e-3)
        return {static_cast<unsigned>(whole) * 1000, 1001};
    const auto thousandths = static_cast<unsigned>(std::max(1L, std::lround(fps * 1000)));
    const unsigned common = std::gcd(thousandths, 1000U);
    return {thousandths / common, 1000 / common};
}

void require_filmable(Shape size, FilmFormat format)
{
    const bool halves = format == FilmFormat::mp4 || format == FilmFormat::webm;
    if (halves && (size.width % 2 || size.height % 2))
        throw UsageError(fmt::format("frames of {}x{} do not fit this kind of film: its width and height are even",
                                     size.width, size.height));
}

struct Film::Sink {
    virtual ~Sink() = default;
    virtual void add(std::span<const std::uint8_t> rgb) = 0;
    virtual void finish() = 0;
};

/// y4m and rgb: to a file, or as they come to standard output.
struct Film::Stream : Film::Sink {
    FilmFormat format;
    std::optional<PendingFile> file;
    std::uint64_t offset = 0;

    Stream(const std::string& name, FilmFormat format_, Shape size, Rate rate) : format(format_)
    {
        if (name != "-") file.emplace(name);
        if (format == FilmFormat::y4m)
            put(fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C444 XCOLORRANGE=LIMITED\n", size.width, size.height,
                            rate.frames, rate.seconds));
    }
    void put(std::string_view bytes)
    {
        if (file)
            file->write(offset, bytes);
        else
            write_all(STDOUT_FILENO, bytes, "standard output");
        offset += bytes.size();
    }
    void add(std::span<const std::uint8_t> rgb) override
    {
        if (format == FilmFormat::rgb) return put({reinterpret_cast<const char*>(rgb.data()), rgb.size()});
        put("FRAME\n");
        put(planes_of(rgb));
    }
    void finish() override
    {
        if (file) file->commit();
    }
};

/// ffmpeg as a child, which reads frames from a pipe and writes the film's temporary file.
struct Film::Encoder : Film::Sink {
    std::string name;
    PendingFile file;
    int to_child = -1, said = -1; ///< said: what it prints
    pid_t child = -1;

    Encoder(const std::string& name_, FilmFormat format, Shape size, Rate rate) : name(name_), file(name_)
    {
        try {
            start(format, size, rate);
        } catch (...) {
            clean_up();
            throw;
        }
    }
    ~Encoder() override { clean_up(); }

    void start(FilmFormat format, Shape size, Rate rate)
    {
        std::array<int, 2> ends{};
        said = ::memfd_create("clucida", MFD_CLOEXEC);
        if (said < 0 || ::pipe2(ends.data(), O_CLOEXEC) != 0)
            throw Failure(fmt::format("cannot start ffmpeg: {}", std::strerror(errno)));
        to_child = ends[1];
        std::vector<std::string> command = words(
            fmt::format("ffmpeg -hide_banner -loglevel error -f rawvideo -pix_fmt rgb24 -s {}x{} -r {}/{} -i pipe:0 "
                        "-fflags +bitexact -flags:v +bitexact",
                        size.width, size.height, rate.frames, rate.seconds));
        for (const std::string& argument : encoder_arguments(format)) command.push_back(argument);
        command.insert(command.end(), {"-y", "file:" + file.temporary_name()});
        try {
            child = start_child(command, {}, {ends[0], said, said});
        } catch (const Failure& e) {
            ::close(ends[0]);
            throw Failure(fmt::format("{} is made by the program ffmpeg: {}; install it (apt install ffmpeg), or write "
                                      "a .y4m film, which needs none",
                                      name, e.what()));
        }
        ::close(ends[0]);
    }

    void add(std::span<const std::uint8_t> rgb) override
    {
        try {
            write_all(to_child, {reinterpret_cast<const char*>(rgb.data()), rgb.size()}, "to ffmpeg");
        } catch (const Failure&) {
            const std::string end = wait();
            throw Failure(fmt::format("{}: ffmpeg ended before the film did ({}){}", name, end, what_it_said()));
        }
    }

    void finish() override
    {
        const std::string end = wait();
        if (end != "exit code 0") throw Failure(fmt::format("{}: ffmpeg failed ({}){}", name, end, what_it_said()));
        file.commit();
    }

    std::string wait()
    {
        if (to_child >= 0) ::close(std::exchange(to_child, -1));
        int status = 0;
        while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
        child = -1;
        return describe_end(status);
    }

    std::string what_it_said() const
    {
        std::string text(2000, '\0');
        const ssize_t size = ::pread(said, text.data(), text.size(), 0);
        text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
        while (text.ends_with('\n')) text.pop_back();
        return text.empty() ? "" : ":\n" + text;
    }

    void clean_up()
    {
        if (child > 0) {
            ::kill(child, SIGKILL);
            wait();
        }
        if (to_child >= 0) ::close(std::exchange(to_child, -1));
        if (said >= 0) ::close(std::exchange(said, -1));
    }
};

Film::Film(const std::string& file, FilmFormat format, Shape size, double fps)
{
    require_filmable(size, format);
    if (is_streamed(format))
        sink_ = std::make_unique<Stream>(file, format, size, rate_of(fps));
    else if (file == "-")
        throw UsageError("ffmpeg's films are files; to standard output go y4m and rgb");
    else {
        require_writable(file);
        sink_ = std::make_unique<Encoder>(file, format, size, rate_of(fps));
    }
}

Film::~Film() = default;

void Film::add(std::span<const std::uint8_t> rgb)
{
    sink_->add(rgb);
}

void Film::finish()
{
    sink_->finish();
}

} // namespace clucida::host
