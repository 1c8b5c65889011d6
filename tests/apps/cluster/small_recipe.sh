# small_recipe SOURCE COUNT: a recipe whose samples are drawn in an instant. To be sourced.
small_recipe() {
  cat <<RECIPE
scene = "$1/scenes/sea_state_3.toml"
count = $2
size_px = [96, 54]
labels = "depth,id"
[range]
t_s = [0, 100]
camera.heading_deg = [-40, 70]
[[objects]]
kind = "buoy"
number = [1, 3]
distance_m = [12, 60]
RECIPE
}
