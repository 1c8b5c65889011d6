"""How a node of ROS 2 hears the boat: python3 watch_node.py, beside start.sh, where ROS 2 is installed.

It has not been run: the machines on which Swell is tested have no ROS 2. watch.cpp does the same without it, and is.
"""
import math

import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from sensor_msgs.msg import Image


class Watch(Node):
    def __init__(self):
        super().__init__("watch")
        self.create_subscription(Image, "/camera/image_raw", self.see, 10)
        self.create_subscription(PoseStamped, "/base_link/pose", self.feel, 10)
        self.roll_deg = 0.0

    def feel(self, message):
        q = message.pose.orientation
        self.roll_deg = math.degrees(math.atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y)))

    def see(self, message):
        self.get_logger().info(f"{message.width}x{message.height} {message.encoding}, roll {self.roll_deg:+.1f} deg")


rclpy.init()
rclpy.spin(Watch())
