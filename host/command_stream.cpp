#include "host/atomic_file.h"
#include "host/commands.h"
#include "host/errors.h"
#include "host/interrupt.h"
#include "host/max_error.h"
#include "host/opencl.h"
#include "host/render_options.h"
#include "host/render_output.h"
#include "scene/error.h"
#include "scene/limits.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <vector>

namespace clucida::host {
namespace {

struct StreamOptions {
    RenderOptions render;
    std::string samples_format = "rgb8";
};

/// Standard input, read such that the wish to stop is heard while it has nothing to say.
class Input {
public:
    void stop() { stopped_ = true; }

    /// A line without its end; empty at the end of input.
    std::optional<std::string> line(std::size_t most)
    {
        std::size_t end = 0;
        while ((end = buffer_.find('\n')) == std::string::npos) {
            if (buffer_.size() > most) throw UsageError("a request's first line is too long");
            if (fill()) continue;
            if (buffer_.empty()) return std::nullopt;
            throw UsageError("the input ends within a request's first line");
        }
        std::string out = buffer_.substr(0, end);
        buffer_.erase(0, end + 1);
        return out;
    }
    std::string bytes(std::size_t count)
    {
        while (buffer_.size() < count)
            if (!fill()) throw UsageError(fmt::format("the input ends within a scene of {} bytes", count));
        std::string out = buffer_.substr(0, count);
        buffer_.erase(0, count);
        return out;
    }

private:
    bool fill() ///< false at the end of input
    {
        constexpr int wait_ms = 100;
        while (true) {
            if (interrupted() || stopped_) throw Interrupted();
            pollfd wanted{STDIN_FILENO, POLLIN, 0};
            if (::poll(&wanted, 1, wait_ms) <= 0) continue;
            char some[1 << 16];
            const ssize_t count = ::read(STDIN_FILENO, some, sizeof some);
            if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
            if (count < 0) throw Failure(fmt::format("standard input: {}", std::strerror(errno)));
            buffer_.append(some, static_cast<std::size_t>(count));
            return count > 0;
        }
    }

    std::string buffer_;
    std::atomic<bool> stopped_{false};
};

struct Request {
    std::string text;
    unsigned frame = 1;
};

/// `scene BYTES` or `scene BYTES FRAME`, a line, and the bytes; nothing at the end of input. After a request that is
/// not understood no other could be found: it ends the program.
std::optional<Request> read_request(Input& input)
{
    const std::optional<std::string> line = input.line(100);
    if (!line) return std::nullopt;
    const auto wrong = [&] { return UsageError(fmt::format("expected 'scene BYTES [FRAME]', not '{}'", *line)); };
    constexpr std::string_view word = "scene ";
    if (!line->starts_with(word)) throw wrong();
    const char* const end = line->data() + line->size();
    std::size_t bytes = 0;
    unsigned frame = 1;
    std::from_chars_result at = std::from_chars(line->data() + word.size(), end, bytes);
    if (at.ec == std::errc{} && at.ptr != end && *at.ptr == ' ') at = std::from_chars(at.ptr + 1, end, frame);
    if (at.ec != std::errc{} || at.ptr != end || frame < 1 || frame > scene::limits::frames) throw wrong();
    if (bytes > scene::limits::text_bytes) {
        throw UsageError(fmt::format("a scene of {} bytes; expected {} at most", bytes, scene::limits::text_bytes));
    }
    return Request{input.bytes(bytes), frame};
}

/// What a request asks for, or what is wrong with it.
struct Prepared {
    std::optional<scene::Compiled> compiled;
    std::string error;
};

/// What `work` throws that is the scene's fault or its size's, as a message; what ends the program is thrown on.
template <typename Work>
std::string message_of(const Work& work)
{
    try {
        work();
        return {};
    } catch (const Interrupted&) {
        throw;
    } catch (const std::bad_alloc&) {
        return "this computer's memory does not suffice";
    } catch (const cl::Error& e) {
        return explain(e);
    } catch (const std::exception& e) {
        return e.what();
    }
}

class Stream {
public:
    explicit Stream(const StreamOptions& options)
        : options_(options), settings_(settings_of(options.render)), team_(make_renderers(devices_of(options.render))),
          folder_(std::filesystem::current_path())
    {
    }

    void run()
    {
        // The next scene is read and compiled while the device traces the present one.
        std::future<std::optional<Prepared>> next = ahead();
        const StopsInput stops{input_}; // else a failure here would wait for the next request
        while (const std::optional<Prepared> now = next.get()) {
            next = ahead();
            answer(*now);
        }
    }

private:
    struct StopsInput {
        Input& input;
        ~StopsInput() { input.stop(); }
    };

    std::future<std::optional<Prepared>> ahead()
    {
        return std::async(std::launch::async, [this] { return prepare(); });
    }

    std::optional<Prepared> prepare()
    {
        std::optional<Request> request = read_request(input_);
        if (!request) return std::nullopt;
        Prepared out;
        out.error = message_of([&] {
            SceneOptions options = options_.render.scene;
            options.moment.frame = request->frame;
            SceneSource source;
            source.name = source.stem = "scene";
            source.text = {"scene", std::move(request->text), scene::Format::clucida, folder_};
            source.scene = read_moment(source, options, nullptr);
            out.compiled = compile_scene(source, source.scene, view_of(options_.render, source), &photographs_);
        });
        return out;
    }

    void answer(const Prepared& prepared)
    {
        std::string body, head;
        std::string error = prepared.error;
        if (error.empty()) error = message_of([&] { body = samples(render(*prepared.compiled)); });
        if (error.empty()) {
            const Shape size = settings_.picture;
            const int bits = options_.samples_format == "float" ? 32 : 8;
            head = fmt::format("picture {} {} 3 {} {}\n", size.width, size.height, bits, body.size());
        } else {
            body = error;
            head = fmt::format("error {}\n", body.size());
        }
        write_all(STDOUT_FILENO, head, "standard output");
        write_all(STDOUT_FILENO, body, "standard output");
    }

    Picture render(const scene::Compiled& compiled)
    {
        Frame frame = render_next(team_, compiled, settings_, needs_, {{}, interrupted, {}});
        tell_notes(frame.notes, options_.render.quiet);
        const std::string faults = describe_faults(frame.statistics);
        if (!faults.empty()) fmt::print(stderr, "clucida: warning: the picture has faults: {}\n", faults);
        return std::move(frame.picture);
    }

    std::string samples(const Picture& picture) const
    {
        if (options_.samples_format == "png") return encode(picture, FileFormat::png);
        if (options_.samples_format == "rgb8") {
            const std::vector<std::uint8_t> bytes = develop_8(picture, Transfer::srgb);
            return {bytes.begin(), bytes.end()};
        }
        static_assert(std::endian::native == std::endian::little, "the stream's floats are little-endian");
        std::string out(picture.rgb.size() * sizeof(float), '\0');
        std::memcpy(out.data(), picture.rgb.data(), out.size());
        return out;
    }

    const StreamOptions& options_;
    RenderSettings settings_;
    std::vector<Renderer> team_;
    std::filesystem::path folder_;
    scene::PhotographCache photographs_;
    scene::Needs needs_; ///< of all scenes so far
    Input input_;
};

void run(StreamOptions o)
{
    if (::isatty(STDOUT_FILENO))
        throw UsageError(
            "pictures are not written to a terminal; `clucida stream` is for other programs, see docs/python.md");
    const RenderSettings settings = settings_of(o.render); // what is wrong with the options is said before any scene
    require_encodable(settings.picture.width, settings.picture.height, FileFormat::png, {});
    choose_by_error(o.render, ""); // once: a scene of a stream is not known before
    Stream(o).run();
}

} // namespace

void add_stream(CLI::App& app)
{
    auto options = std::make_shared<StreamOptions>();
    CLI::App* command = app.add_subcommand(
        "stream", "Render scenes that come by standard input, one after the other, for other programs");
    RenderOptions& o = options->render;
    command->add_option("--allow-path", o.scene.allow_path, "photographs may also lie beneath this folder")
        ->option_text("FOLDER");
    command->add_option("-s,--size", o.size, "of the pictures in pixels")->option_text("WxH")->capture_default_str();
    command
        ->add_option("--samples-format", options->samples_format,
                     "of the pictures: rgb8 (bytes, sRGB), float (32 bits, linear, little-endian) or png")
        ->check(CLI::IsMember({"rgb8", "float", "png"}))
        ->option_text("NAME")
        ->capture_default_str();
    add_tracing_options(*command, o);
    command->add_flag("-q,--quiet", o.quiet, "print errors and warnings only");
    command->footer(
        "A request is a line `scene BYTES [FRAME]` and that many bytes of scene text; photographs lie beneath the\n"
        "working folder. The answer is a line `picture WIDTH HEIGHT CHANNELS BITS BYTES` and as many bytes, or\n"
        "`error BYTES` and a message, after which the next request is read. The end of input ends the program.");
    command->callback([options] { run(*options); });
}

} // namespace clucida::host
