// Draws a scene into a PNG file: embed SCENE.toml PICTURE.png
#include <swell/render/frame.h>
#include <swell/render/world_view.h>
#include <swell/texture/image/image_io.h>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const swell::render::World world(swell::scene::load_scene(argv[1]));
  swell::Workers workers(swell::available_cpus());
  swell::render::Workspace workspace;
  swell::render::Target target;
  const double t_s = 0.0;
  swell::ocean::SeaFrame sea;  // for a camera that an object carries
  const auto view = swell::render::world_view(world, t_s, 640, 360, sea, workers);
  swell::render::render_frame(world, view, t_s, {}, workspace, target, workers);

  swell::texture::Image8 image{target.width_px, target.height_px, 3, {}};
  for (const std::uint32_t pixel : target.rgba)
    for (int c = 0; c < 3; ++c) image.pixels.push_back(std::uint8_t(pixel >> (8 * c)));
  swell::texture::write_file(argv[2], swell::texture::encode_image(image, ".png"));
}
