// A program at the other end of Gazebo's transport, made of its libraries alone.
//   gazebo_peer listen TOPIC TYPE ...
//     says "ready" when all are published, then a line of JSON for each message
//   gazebo_peer say TOPIC TYPE ...
//     says "ready" when all are heard, then publishes lines 'TOPIC TEXT' of its input
//   gazebo_peer visit COUNT TOPIC TYPE
//     subscribes so many times, and goes again
//   gazebo_peer damage COUNT TOPIC TYPE TEXT
//     publishes so many messages whose bytes are damaged, once it is heard
//   gazebo_peer heights
//     asks /water/heights for each line TEXT of its input: a line of JSON, or "refused"
// TYPE is a message's name without its package, TEXT protobuf's text format. All but visit and
// damage end with their input.
#include <google/protobuf/text_format.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "apps/gazebo/mutation.h"
#include "apps/gazebo/names.h"

namespace {

namespace msgs = swell::apps::gz_msgs;
using google::protobuf::Message;
using std::chrono::milliseconds;
using swell::apps::gz_transport::MessageInfo;
using swell::apps::gz_transport::Node;

// "ignition.msgs." or "gz.msgs."
std::string package() {
  const std::string name = msgs::Empty().GetTypeName();
  return name.substr(0, name.rfind('.') + 1);
}

std::unique_ptr<Message> message_of(const std::string& type) {
  const auto* descriptor =
      google::protobuf::DescriptorPool::generated_pool()->FindMessageTypeByName(type);
  if (!descriptor) throw std::runtime_error("no type " + type);
  return std::unique_ptr<Message>(
      google::protobuf::MessageFactory::generated_factory()->GetPrototype(descriptor)->New());
}

std::string json(const Message& message) {
  std::string text;
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  if (!google::protobuf::util::MessageToJsonString(message, &text, options).ok())
    throw std::runtime_error("no JSON");
  return text;
}

// FNV-1a.
std::uint64_t hash_of(const char* bytes, std::size_t size) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (std::size_t i = 0; i < size; ++i)
    hash = (hash ^ static_cast<std::uint8_t>(bytes[i])) * 0x100000001b3;
  return hash;
}

void say_ready() { std::cout << "ready" << std::endl; }

void wait_for_end() {
  for (std::string line; std::getline(std::cin, line);) {
  }
}

int listen(const std::vector<std::string>& words) {
  Node node;
  std::mutex mutex;
  for (std::size_t n = 0; n + 1 < words.size(); n += 2) {
    const std::string& topic = words[n];
    const std::string type = package() + words[n + 1];
    const auto print = [&mutex, topic, type](const char* bytes, std::size_t size,
                                             const MessageInfo&) {
      const auto message = message_of(type);
      const bool is_read = message->ParseFromArray(bytes, static_cast<int>(size));
      const std::lock_guard lock(mutex);
      std::cout << "{\"topic\": \"" << topic << "\", \"hash\": \"" << hash_of(bytes, size)
                << "\", \"message\": " << (is_read ? json(*message) : "null") << "}" << std::endl;
    };
    if (!node.SubscribeRaw(topic, print, type)) return 1;
  }
  for (std::size_t n = 0; n + 1 < words.size(); n += 2) {
    std::vector<std::string> topics;
    while (std::ranges::count(topics, words[n]) == 0) {
      std::this_thread::sleep_for(milliseconds(20));
      node.TopicList(topics);
    }
  }
  std::this_thread::sleep_for(milliseconds(1000));  // until the publisher knows
  say_ready();
  wait_for_end();
  return 0;
}

int say(const std::vector<std::string>& words) {
  Node node;
  std::map<std::string, std::pair<Node::Publisher, std::unique_ptr<Message>>> topics;
  for (std::size_t n = 0; n + 1 < words.size(); n += 2) {
    auto message = message_of(package() + words[n + 1]);
    auto publisher = node.Advertise(words[n], message->GetTypeName());
    topics[words[n]] = {publisher, std::move(message)};
  }
  for (auto& [name, topic] : topics)
    while (!topic.first.HasConnections()) std::this_thread::sleep_for(milliseconds(20));
  std::this_thread::sleep_for(milliseconds(1000));
  say_ready();
  for (std::string line; std::getline(std::cin, line);) {
    const std::size_t space = line.find(' ');
    auto& [publisher, message] = topics.at(line.substr(0, space));
    if (!google::protobuf::TextFormat::ParseFromString(line.substr(space + 1), message.get()))
      return 1;
    publisher.Publish(*message);
  }
  std::this_thread::sleep_for(milliseconds(500));
  return 0;
}

int visit(const std::vector<std::string>& words) {
  for (int n = std::stoi(words.at(0)); n > 0; --n) {
    Node node;
    node.SubscribeRaw(
        words.at(1), [](const char*, std::size_t, const MessageInfo&) {}, package() + words.at(2));
    std::this_thread::sleep_for(milliseconds(5));
  }
  return 0;
}

int damage(const std::vector<std::string>& words) {
  Node node;
  const auto message = message_of(package() + words.at(2));
  if (!google::protobuf::TextFormat::ParseFromString(words.at(3), message.get())) return 1;
  const std::string bytes = message->SerializeAsString();
  auto publisher = node.Advertise(words.at(1), message->GetTypeName());
  while (!publisher.HasConnections()) std::this_thread::sleep_for(milliseconds(20));
  std::this_thread::sleep_for(milliseconds(1000));
  std::mt19937 random(3);
  for (int n = std::stoi(words.at(0)); n > 0; --n)
    publisher.PublishRaw(swell::apps::mutated(bytes, random), message->GetTypeName());
  std::this_thread::sleep_for(milliseconds(500));
  return 0;
}

template <class Request, class Reply>
int ask(const std::string& service) {
  Node node;
  for (std::string line; std::getline(std::cin, line);) {
    Request request;
    Reply reply;
    bool is_answered = false;
    if (!google::protobuf::TextFormat::ParseFromString(line, &request)) return 1;
    const bool is_in_time = node.Request(service, request, 10'000u, reply, is_answered);
    std::cout << (!is_in_time ? "late" : is_answered ? json(reply) : "refused") << std::endl;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string mode = argc > 1 ? argv[1] : "";
  const std::vector<std::string> words(argv + (argc > 1 ? 2 : 1), argv + argc);
  if (mode == "listen") return listen(words);
  if (mode == "say") return say(words);
  if (mode == "visit") return visit(words);
  if (mode == "damage") return damage(words);
  if (mode == "heights") return ask<msgs::Pose_V, msgs::Pose_V>("/water/heights");
  return 2;
} catch (const std::exception& fault) {
  std::fprintf(stderr, "gazebo_peer: %s\n", fault.what());
  return 1;
}
