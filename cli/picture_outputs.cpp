#include "cli/picture_outputs.hpp"

#include <filesystem>
#include <optional>

#include "cli/accuracy_report.hpp"
#include "cli/version.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/resize.hpp"
#include "render/math/clock.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

render::WriteOptions write_options(const Output& output, const PictureForm& form,
                                   const render::RenderSettings& settings,
                                   const render::RenderResult& result) {
  std::optional<render::ToneMapping> mapping;
  if (!describe(output.format).is_linear) mapping = form.mapping;
  render::PixelWindow whole;
  if (settings.crop) {
    whole = {.x = -settings.crop->x * form.zoom,
             .y = -settings.crop->y * form.zoom,
             .width = settings.width * form.zoom,
             .height = settings.height * form.zoom};
  }
  return {.format = output.format,
          .mapping = form.mapping,
          .ppm_text = form.ppm_text,
          .metadata = {.software = fmt::format("sdlc {}", kVersion),
                       .entries = picture_metadata(settings, result, mapping)},
          .whole = whole,
          .layers = {}};
}

void write_to_stdout(const render::Picture& picture, const render::WriteOptions& options,
                     Environment& env) {
  const auto bytes = render::encode_picture(picture, options, "standard output");
  env.out.write(reinterpret_cast<const char*>(bytes.data()),
                static_cast<std::streamsize>(bytes.size()));
  if (!env.out.flush()) throw render::IoError("write", "standard output", "the write failed");
}

/// Every `step`-th row.
render::Picture rows_of(const render::Picture& picture, int step) {
  render::Picture rows(picture.width, (picture.height + step - 1) / step);
  for (int y = 0; y < rows.height; ++y) {
    for (int x = 0; x < rows.width; ++x) rows.at(x, y) = picture.at(x, step * y);
  }
  return rows;
}

/// The seconds to encode a picture with as many layers as were requested, which do not exist yet.
double seconds_to_encode(const render::Picture& picture, const Output& output,
                         const PictureForm& form, std::size_t channels) {
  std::vector<render::Layer> layers(channels);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    layers[i].name = std::to_string(i);
    for (const render::LinearRgb& pixel : picture.pixels) {
      layers[i].values.push_back(render::to_float(pixel.g));
    }
  }
  const auto start = render::Clock::now();
  render::encode_picture(picture, {.format = output.format,
                                   .mapping = form.mapping,
                                   .ppm_text = form.ppm_text,
                                   .layers = layers});
  return render::seconds_since(start);
}

}  // namespace

std::vector<std::string> Written::all() const {
  std::vector<std::string> all = names;
  all.insert(all.end(), films.begin(), films.end());
  return all;
}

Written write_pictures(const std::vector<Output>& outputs, const PictureForm& form,
                       const render::RenderSettings& settings, const render::RenderResult& result,
                       std::span<const render::Layer> layers, Environment& env) {
  Written written;
  const int width = result.picture.width;
  std::optional<render::Picture> large;
  std::vector<render::Layer> large_layers;
  if (form.zoom > 1) {
    large = enlarged(result.picture, form.zoom);
    for (const render::Layer& layer : layers) {
      large_layers.push_back(enlarged(layer, width, form.zoom));
    }
    layers = large_layers;
  }
  const render::Picture& picture = large ? *large : result.picture;
  for (const Output& output : outputs) {
    if (output.is_film) continue;
    render::WriteOptions write = write_options(output, form, settings, result);
    write.layers = layers;
    fs::path path = output.path;
    try_to_write(written.code, env, [&] {
      if (output.is_stdout) {
        write_to_stdout(picture, write, env);
      } else {
        if (!result.is_complete) path = partial_name(path);
        std::optional<render::ParentFolders> folders;
        if (output.may_make_folders) folders.emplace(path);
        render::write_picture(path, picture, write);
      }
      written.names.push_back(lang::printable(path.string()));
    });
  }
  return written;
}

void write_stats(const std::string& path, const std::string& lines, Environment& env) {
  if (path == kStandardStream) {
    env.out << lines << std::flush;
  } else {
    render::write_file_atomically(path, std::as_bytes(std::span(lines)));
  }
}

double seconds_to_write(const render::Picture& picture, const std::vector<Output>& outputs,
                        const PictureForm& form, std::size_t channels) {
  constexpr int kStep = 16;
  constexpr double kSecondsPerFile = 0.02;
  const render::Picture rows = enlarged(rows_of(picture, kStep), form.zoom),
                        row = enlarged(rows_of(picture, picture.height), form.zoom);
  double seconds = kSecondsPerFile * static_cast<double>(outputs.size());
  try {
    for (const Output& output : outputs) {
      if (output.is_film) continue;
      seconds_to_encode(row, output, form, channels);  // waits for the codec
      seconds += kStep * seconds_to_encode(rows, output, form, channels);
    }
  } catch (const render::IoError&) {  // writing will report it
  }
  return seconds;
}

}  // namespace sdlc::cli
