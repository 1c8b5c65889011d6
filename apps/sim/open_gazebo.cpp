#include "apps/gazebo/gazebo_inputs.h"
#include "apps/gazebo/gazebo_output.h"
#include "apps/sim/transport.h"

namespace swell::apps {
namespace {

class GazeboSource : public InputSource {
 public:
  GazeboSource(const std::string& poses, bool takes_clock, Inputs& inputs)
      : inputs_(inputs), gazebo_({inputs.frames(), poses, takes_clock}, takers_of(inputs)) {
    inputs.begin();
  }
  ~GazeboSource() override {
    inputs_.stop();  // it may wait for the loop
  }

 private:
  static GazeboTakers takers_of(Inputs& inputs) {
    return {
        [&inputs](std::string_view topic, std::int64_t t_ns) { inputs.put_clock({topic}, t_ns); },
        [&inputs](std::string_view topic, std::string_view frame, std::int64_t t_ns,
                  const msg::Pose& pose) {
          const auto& [p, q] = pose;
          inputs.put_pose({topic}, frame, {t_ns, {p.x, p.y, p.z}, {q.w, q.x, q.y, q.z}});
        },
        [&inputs](std::string_view topic, const std::string& what) {
          inputs.refuse({topic}, what);
        }};
  }

  Inputs& inputs_;
  GazeboInputs gazebo_;
};

class GazeboTransport : public Transport {
 public:
  explicit GazeboTransport(std::string poses) : poses_(std::move(poses)) {}

  std::unique_ptr<MessageOutput> output(std::span<const Topic> topics,
                                        const scene::Water& water) override {
    auto output = std::make_unique<GazeboOutput>(topics, water);
    audience_ = output->audience();
    return output;
  }
  std::unique_ptr<InputSource> source(bool takes_clock, Inputs& inputs) override {
    return std::make_unique<GazeboSource>(poses_, takes_clock, inputs);
  }
  std::string audience() const override { return audience_; }

 private:
  std::string poses_, audience_;
};

}  // namespace

std::unique_ptr<Transport> open_gazebo(const std::string& poses) {
  check_gazebo();
  return std::make_unique<GazeboTransport>(poses);
}

}  // namespace swell::apps
