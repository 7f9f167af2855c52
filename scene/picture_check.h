/// Guards stb_image against pictures that it does not guard itself against. Debian 12 has its version 2.27, with which
/// a damaged file can hang the program or make it read and write outside its tables; later versions check the same.
#pragma once

#include <string>
#include <string_view>

namespace clucida::scene {

/// What is wrong with the bytes of a picture, or nothing. What it lets pass need not be a picture at all.
std::string picture_fault(std::string_view bytes);

} // namespace clucida::scene
