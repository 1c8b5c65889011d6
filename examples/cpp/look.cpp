// Draws a scene and asks its water: look SCENE.toml
#include <iostream>
#include <swell.hpp>

int main(int argc, char** argv) try {
  swell::World world(argc > 1 ? argv[1] : "scenes/lagoon.toml");
  const swell::Picture picture = world.render(5.0, {640, 360}, {.labels = {"depth"}});
  std::cout << "frame 0 xxh3 " << picture.hash() << '\n'
            << picture.plane<float>("depth").at(320, 300) << " m ahead\n"
            << world.height({{0.0, 50.0}}, 5.0)[0] << " m over the mean sea level\n";
} catch (const swell::Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
