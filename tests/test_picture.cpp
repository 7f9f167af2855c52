#include "host/compare.h"
#include "host/errors.h"
#include "host/picture_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clucida::host {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

/// Numbers all over 0..1, and some beyond.
Picture ramp(unsigned width, unsigned height)
{
    Picture p = make_picture(width, height);
    std::uint32_t state = 1;
    for (float& v : p.rgb) {
        state = state * 1664525 + 1013904223;
        v = static_cast<float>(state >> 8) * 0x1p-24f * 1.1f;
    }
    return p;
}

Picture of(std::initializer_list<float> values)
{
    Picture p = make_picture(static_cast<unsigned>(values.size() / 3), 1);
    std::copy(values.begin(), values.end(), p.rgb.begin());
    return p;
}

TEST(Development, bytes_are_srgb_rounded_to_nearest_for_every_number)
{
    Picture p = make_picture(1U << 15, 2);
    for (std::size_t i = 0; i < p.rgb.size(); ++i)
        p.rgb[i] = static_cast<float>(i) / static_cast<float>(p.rgb.size() - 1);
    const auto bytes = develop_8(p, Transfer::srgb);
    const auto linear = develop_8(p, Transfer::linear);
    for (std::size_t i = 0; i < p.rgb.size(); ++i) {
        ASSERT_EQ(bytes[i], std::lround(srgb_encode(p.rgb[i]) * 255)) << p.rgb[i];
        ASSERT_EQ(linear[i], std::lround(double{p.rgb[i]} * 255)) << p.rgb[i];
    }
}

TEST(Development, known_values_are_those_of_the_standard)
{
    const auto bytes = develop_8(of({0.0F, 1.0F, 0.5F, 0.2140411F, 0.0031308F, 0.18F}), Transfer::srgb);
    EXPECT_EQ(bytes, (std::vector<std::uint8_t>{0, 255, 188, 127, 10, 118}));
    EXPECT_EQ(develop_16(of({0.0F, 1.0F, 0.5F}), Transfer::linear), (std::vector<std::uint16_t>{0, 65535, 32768}));
}

TEST(Development, what_lies_beyond_is_clamped_and_what_is_no_number_is_black)
{
    const Picture p = of({-1.0F, 2.0F, nan, infinite, -infinite, -0.0F});
    EXPECT_EQ(develop_8(p, Transfer::srgb), (std::vector<std::uint8_t>{0, 255, 0, 255, 0, 0}));
    EXPECT_EQ(develop_16(p, Transfer::srgb), (std::vector<std::uint16_t>{0, 65535, 0, 65535, 0, 0}));
}

TEST(Development, srgb_encodes_and_decodes_to_the_same)
{
    for (int i = 0; i < 65536; ++i) EXPECT_EQ(std::lround(srgb_encode(srgb_decode(i / 65535.)) * 65535), i);
}

TEST(PictureFile, integer_formats_come_back_with_the_bytes_they_were_given)
{
    for (const auto& [width, height] : {std::pair{1U, 1U}, {1U, 7U}, {37U, 23U}, {700U, 600U}}) {
        const Picture p = ramp(width, height);
        for (const FileFormat format : {FileFormat::png, FileFormat::ppm})
            for (const Transfer transfer : {Transfer::srgb, Transfer::linear}) {
                EncodeOptions o{.transfer = transfer, .metadata = {{"Command", "a"}, {"Scene", "\xc3\xa4"}}};
                const Picture eight = decode(encode(p, format, o), "test", transfer);
                ASSERT_EQ(eight.width, width);
                ASSERT_EQ(eight.height, height);
                EXPECT_EQ(develop_8(eight, transfer), develop_8(p, transfer));
                o.depth = 16;
                EXPECT_EQ(develop_16(decode(encode(p, format, o), "test", transfer), transfer),
                          develop_16(p, transfer));
            }
    }
}

TEST(PictureFile, a_grey_map_of_16_bits_is_read)
{
    const Picture p = decode(std::string_view("P5 2 1 65535\n\xff\xff\x80\x00", 17), "test", Transfer::linear);
    const float half = 32768.F / 65535.F;
    EXPECT_EQ(p.rgb, (std::vector<float>{1, 1, 1, half, half, half}));
}

// With stb_image 2.27 it waits for ever.
TEST(PictureFile, a_radiance_picture_that_ends_within_a_run_is_refused)
{
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n";
    bytes += std::string("\x02\x02\x00\x08\x88\x64", 6);
    EXPECT_THROW(decode(bytes, "test"), Failure);
}

TEST(PictureFile, float_maps_come_back_bit_for_bit)
{
    const Picture p = ramp(37, 23);
    EXPECT_EQ(decode(encode(p, FileFormat::pfm), "test").rgb, p.rgb);
}

TEST(PictureFile, radiance_keeps_a_part_in_128_of_the_brightest_channel)
{
    for (const unsigned width : {5U, 37U}) { // flat, and run-length encoded
        const Picture p = ramp(width, 23), q = decode(encode(p, FileFormat::hdr), "test");
        ASSERT_EQ(q.rgb.size(), p.rgb.size());
        for (std::size_t i = 0; i < p.rgb.size(); ++i) ASSERT_NEAR(q.rgb[i], p.rgb[i], 2.0F / 128);
    }
}

TEST(PictureFile, jpeg_of_one_colour_keeps_it)
{
    Picture p = make_picture(64, 64);
    for (float& v : p.rgb) v = 0.5F;
    const auto bytes = develop_8(decode(encode(p, FileFormat::jpeg, {.quality = 95}), "test"), Transfer::srgb);
    for (const auto b : bytes) ASSERT_NEAR(b, 188, 2);
}

TEST(PictureFile, png_holds_its_text_and_the_same_input_gives_the_same_bytes)
{
    const EncodeOptions o{.metadata = {{"Command", "clucida render a"}, {"Name", "\xc3\xa4"}}};
    const std::string bytes = encode(ramp(9, 9), FileFormat::png, o);
    using namespace std::string_literals;
    EXPECT_NE(bytes.find("tEXtCommand\0clucida render a"s), std::string::npos);
    EXPECT_NE(bytes.find("iTXtName\0\0\0\0\0\xc3\xa4"s), std::string::npos);
    EXPECT_EQ(bytes, encode(ramp(9, 9), FileFormat::png, o));
}

TEST(PictureFile, it_is_the_same_to_the_byte_whatever_bands_its_rows_come_in)
{
    const auto written = [](const Picture& p, FileFormat format, const EncodeOptions& options, std::size_t rows) {
        std::string out;
        PictureWriter writer(p.width, p.height, format, options, [&](std::uint64_t offset, std::string_view bytes) {
            out.resize(std::max<std::size_t>(out.size(), offset + bytes.size()));
            out.replace(offset, bytes.size(), bytes);
        });
        const std::span<const float> all(p.rgb);
        const std::size_t band = rows * 3 * p.width;
        for (std::size_t at = 0; at < all.size(); at += band)
            writer.add(all.subspan(at, std::min(band, all.size() - at)));
        writer.finish();
        return out;
    };
    for (const auto& [width, height] : {std::pair{1U, 1U}, {1U, 7U}, {37U, 23U}, {700U, 600U}}) {
        const Picture p = ramp(width, height);
        for (const FileFormat format :
             {FileFormat::png, FileFormat::jpeg, FileFormat::hdr, FileFormat::pfm, FileFormat::ppm})
            for (const unsigned depth : {8U, 16U}) {
                const EncodeOptions options{.depth = depth, .metadata = {{"Command", "a"}}};
                if (depth == 16 && format != FileFormat::png && format != FileFormat::ppm) continue;
                const std::string whole = encode(p, format, options);
                for (const std::size_t rows : {1, 5, 599})
                    EXPECT_TRUE(written(p, format, options, rows) == whole)
                        << width << 'x' << height << ", format " << static_cast<int>(format) << ", bands of " << rows;
            }
    }
}

TEST(PictureFile, a_radiance_picture_begins_with_the_size_of_all_its_bands)
{
    const std::string bytes = encode(ramp(700, 600), FileFormat::hdr);
    const std::size_t end = bytes.find("\n\n");
    ASSERT_NE(end, std::string::npos);
    EXPECT_EQ(bytes.substr(0, 11), "#?RADIANCE\n");
    EXPECT_EQ(bytes.substr(end + 2, 15), "-Y 600 +X 700\n\x02");
    EXPECT_EQ(bytes.find("RADIANCE", 11), std::string::npos);
}

TEST(PictureFile, the_ending_decides_whatever_its_case)
{
    EXPECT_EQ(file_format("a/b.PNG"), FileFormat::png);
    EXPECT_EQ(file_format("b.jpeg"), FileFormat::jpeg);
    EXPECT_EQ(file_format("pfm"), FileFormat::pfm);
    EXPECT_FALSE(file_format("a.exr"));
    EXPECT_FALSE(file_format("a."));
}

TEST(PictureFile, what_a_format_cannot_hold_is_refused)
{
    EXPECT_THROW(require_encodable(1, 1, FileFormat::png, {.depth = 12}), UsageError);
    EXPECT_THROW(require_encodable(1, 1, FileFormat::jpeg, {.depth = 16}), UsageError);
    EXPECT_THROW(require_encodable(1, 1, FileFormat::jpeg, {.quality = 0}), UsageError);
    EXPECT_THROW(require_encodable(65536, 1, FileFormat::jpeg, {}), UsageError);
    EXPECT_THROW(require_encodable(32768, 32768, FileFormat::jpeg, {}), UsageError);
    EXPECT_NO_THROW(require_encodable(16384, 16384, FileFormat::jpeg, {}));
}

TEST(PictureFile, what_is_no_picture_is_refused_not_read)
{
    const std::string png = encode(ramp(37, 23), FileFormat::png), pfm = encode(ramp(37, 23), FileFormat::pfm);
    for (const std::string& bytes :
         {std::string(), std::string("PF"), std::string("PF\n0 0\n-1\n"), std::string("PF\n99999 99999\n-1\n"),
          std::string("hello"), std::string("P6\n9 9\n255\nx"), std::string("P6 # 3 3 255"), pfm.substr(0, 500),
          png.substr(0, 20)})
        EXPECT_THROW(decode(bytes, "test"), Failure) << bytes.substr(0, 20);
}

TEST(Compare, equal_pictures_have_no_distance)
{
    const Picture p = ramp(5, 5);
    const Comparison c = compare(p, p, 0);
    EXPECT_EQ(c.rmse, 0);
    EXPECT_EQ(c.max_error, 0);
    EXPECT_EQ(c.over, 0U);
    EXPECT_TRUE(std::isinf(c.psnr) && c.psnr > 0);
    EXPECT_EQ(compare_bytes(p, p).equal, 25U);
}

TEST(Compare, the_measures_are_those_of_their_definitions)
{
    const Picture a = of({0, 0, 0, 0.5F, 0, 0}), b = of({0, 0.5F, 0, 0.5F, 0, 0.25F});
    const Comparison c = compare(a, b, 0.25);
    EXPECT_DOUBLE_EQ(c.rmse, std::sqrt((0.25 + 0.0625) / 6));
    EXPECT_DOUBLE_EQ(c.psnr, 10 * std::log10(1 / ((0.25 + 0.0625) / 6)));
    EXPECT_DOUBLE_EQ(c.mean_error, 0.75 / 6);
    EXPECT_DOUBLE_EQ(c.max_error, 0.5);
    EXPECT_EQ(c.max_x, 0U);
    EXPECT_EQ(c.max_channel, 1U);
    EXPECT_EQ(c.over, 1U) << "the second pixel differs by the threshold, not by more";
    const ByteComparison bytes = compare_bytes(a, b, Transfer::linear);
    EXPECT_EQ(bytes.max_steps, 128U);
    EXPECT_EQ(bytes.equal, 0U);
    EXPECT_DOUBLE_EQ(bytes.mean_steps, (128 + 64) / 6.0);
}

TEST(Compare, what_is_no_number_is_counted_and_left_out)
{
    const Comparison c = compare(of({nan, 0, infinite}), of({nan, 0.5F, infinite}), 0);
    EXPECT_EQ(c.not_numbers, 1U);
    EXPECT_DOUBLE_EQ(c.rmse, std::sqrt(0.25 / 2));
}

TEST(Compare, a_percentile_is_the_least_error_that_so_many_do_not_exceed)
{
    Picture a = make_picture(1000, 1), b = a; // differences of 1, 2, ... 3000, in no order
    for (unsigned i = 0; i < 3000; ++i) b.rgb[i] = static_cast<float>(i * 1237 % 3000 + 1);
    const Comparison c = compare(a, b, 0);
    EXPECT_EQ(c.p50, 1500);
    EXPECT_EQ(c.p99, 2970);
    EXPECT_EQ(c.p999, 2997);
    EXPECT_EQ(compare(a, a, 0).p999, 0);
}

TEST(Compare, percentiles_leave_out_what_is_no_number)
{
    const Comparison c = compare(of({nan, 1, 2}), of({0, 0, 0}), 0);
    EXPECT_EQ(c.p50, 1);
    EXPECT_EQ(c.p999, 2);
    EXPECT_EQ(compare(of({nan, nan, nan}), of({0, 0, 0}), 0).p50, 0);
}

TEST(Compare, the_map_shows_each_pixels_largest_error)
{
    const Plane map = error_map(of({0, 0.5F, 1, 0, 0, 0, infinite, 0, 0, nan, 1, 0}),
                                of({0, 0.25F, 0.5F, 0, 0, 0, infinite, 1, 0, 0, 0, 0}));
    EXPECT_EQ((std::vector<float>{map.value.begin(), map.value.begin() + 3}), (std::vector<float>{0.5F, 0, 1}));
    EXPECT_TRUE(std::isnan(map.value[3]));
}

TEST(Compare, pictures_of_different_sizes_are_refused)
{
    EXPECT_THROW(compare(make_picture(2, 3), make_picture(3, 2), 0), Failure);
}

} // namespace
} // namespace clucida::host
