#include "bench/lab/grey_picture.hpp"

#include <cctype>
#include <charconv>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include <png.h>

#include "clients/common/failure.hpp"

namespace cairn::lab {
namespace {

using clients::ExitCode;
using clients::Failure;

constexpr std::size_t kMaxPixels = 100'000'000;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw Failure(ExitCode::kBadData, file.string() + ": " + why);
}

void check_size(const std::filesystem::path& file, std::size_t width, std::size_t height) {
  if (width == 0 || height == 0 || width > kMaxPixels || height > kMaxPixels / width) {
    refuse(file, "expected a picture of 1 to 100 million pixels, has " + std::to_string(width) +
                     " x " + std::to_string(height));
  }
}

/// The simplified interface of libpng: it reports by return value and never jumps.
class PngReader {
 public:
  PngReader() { image_.version = PNG_IMAGE_VERSION; }
  ~PngReader() { png_image_free(&image_); }
  PngReader(const PngReader&) = delete;
  PngReader(PngReader&&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  PngReader& operator=(PngReader&&) = delete;

  GreyPicture read(const std::filesystem::path& file, const std::string& bytes) {
    if (png_image_begin_read_from_memory(&image_, bytes.data(), bytes.size()) == 0) {
      refuse(file, std::string("not a PNG picture: ") + image_.message);
    }
    check_size(file, image_.width, image_.height);
    image_.format = PNG_FORMAT_GRAY;
    GreyPicture picture{static_cast<int>(image_.width), static_cast<int>(image_.height), {}};
    picture.grey.resize(std::size_t{image_.width} * image_.height);
    const png_color black = {0, 0, 0};
    if (png_image_finish_read(&image_, &black, picture.grey.data(), 0, nullptr) == 0) {
      refuse(file, std::string("the picture is damaged: ") + image_.message);
    }
    return picture;
  }

 private:
  png_image image_{};
};

/// The numbers of a PGM's header, between white space and comments.
class PgmHeader {
 public:
  PgmHeader(const std::filesystem::path& file, const std::string& bytes)
      : file_(file), bytes_(bytes) {}

  std::size_t number() {
    skip();
    std::size_t value = 0;
    const char* const end = bytes_.data() + bytes_.size();
    const auto [rest, error] = std::from_chars(bytes_.data() + at_, end, value);
    if (error != std::errc()) {
      refuse(file_, "expected a PGM header: P5, width, height, 255");
    }
    at_ = static_cast<std::size_t>(rest - bytes_.data());
    return value;
  }

  /// Where the pixels begin: after one white space.
  [[nodiscard]] std::size_t end() const { return at_ + 1; }

 private:
  void skip() {
    while (at_ < bytes_.size() &&
           (std::isspace(static_cast<unsigned char>(bytes_[at_])) != 0 || bytes_[at_] == '#')) {
      at_ = bytes_[at_] == '#' ? std::min(bytes_.find('\n', at_), bytes_.size()) : at_ + 1;
    }
  }

  const std::filesystem::path& file_;
  const std::string& bytes_;
  std::size_t at_ = 2;
};

GreyPicture read_pgm(const std::filesystem::path& file, const std::string& bytes) {
  PgmHeader header(file, bytes);
  const std::size_t width = header.number();
  const std::size_t height = header.number();
  const std::size_t white = header.number();
  check_size(file, width, height);
  if (white != 255) {
    refuse(file, "expected a PGM of 8 bits, white = 255, has " + std::to_string(white));
  }
  if (bytes.size() < header.end() || bytes.size() - header.end() < width * height) {
    refuse(file, "the picture is cut short");
  }
  GreyPicture picture{static_cast<int>(width), static_cast<int>(height), {}};
  const auto* const first = bytes.data() + header.end();
  picture.grey.assign(first, first + width * height);
  return picture;
}

}  // namespace

GreyPicture read_grey_picture(const std::filesystem::path& file) {
  std::error_code is_no_file;
  std::ifstream stream;
  if (std::filesystem::is_regular_file(file,
                                       is_no_file)) {  // A folder can be opened, but not read.
    stream.open(file, std::ios::binary);
  }
  if (!stream.is_open()) {
    refuse(file, "cannot be read");
  }
  std::ostringstream content;
  content << stream.rdbuf();
  const std::string bytes = content.str();
  return bytes.rfind("P5", 0) == 0 ? read_pgm(file, bytes) : PngReader().read(file, bytes);
}

OccupancyGrid grid_of(const GreyPicture& picture, double cell_m) {
  constexpr std::uint8_t kLightestOccupied = 89;  // As map_server of ROS: occupied above 65 %.
  GridGeometry geometry;
  geometry.cell_m = cell_m;
  geometry.width = picture.width;
  geometry.height = picture.height;
  OccupancyGrid grid(geometry);
  std::size_t pixel = 0;
  for (int y = picture.height - 1; y >= 0; --y) {
    for (int x = 0; x < picture.width; ++x, ++pixel) {
      if (is_free_shade(picture.grey[pixel])) {
        grid.log_odds({x, y}) = 2 * OccupancyGrid::kFreeBelow;
      } else if (picture.grey[pixel] <= kLightestOccupied) {
        grid.log_odds({x, y}) = 2 * OccupancyGrid::kOccupiedAbove;
      }
    }
  }
  return grid;
}

}  // namespace cairn::lab
