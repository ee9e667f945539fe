#include <vector>

#include <png.h>

#include "clients/common/canvas.hpp"
#include "clients/common/failure.hpp"
#include "clients/common/text.hpp"

namespace cairn::clients {
namespace {

static_assert(sizeof(Colour) == 3, "libpng reads rows of pixels as bytes");

// The simplified interface of libpng: it reports by return value and never jumps.
std::string encoded(const Canvas& canvas, const std::vector<Colour>& pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(canvas.width());
  image.height = static_cast<png_uint_32>(canvas.height());
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  const bool is_written =
      png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr) != 0;
  png_image_free(&image);
  if (!is_written) {
    throw Failure(ExitCode::kCannotCreate,
                  std::string("cannot encode the picture: ") + image.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace

void write_png(const Canvas& canvas, const std::filesystem::path& path) {
  std::vector<Colour> pixels;
  pixels.reserve(static_cast<std::size_t>(canvas.width()) *
                 static_cast<std::size_t>(canvas.height()));
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) {
      pixels.push_back(canvas.at(x, y));
    }
  }
  write_file(path, encoded(canvas, pixels));
}

}  // namespace cairn::clients
