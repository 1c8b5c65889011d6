"""Checks annotations.json against a schema of COCO's object detection format: check_coco.py FILE.

Where there is python3-opencv, the boxes and runs also against the masks of instances, as OpenCV reads and measures them.
Exits with 77 where python3-jsonschema is missing. Source of the format: cocodataset.org/#format-data.
"""

import json
import pathlib
import sys

try:
    import jsonschema
except ImportError:
    sys.exit(77)


def table(properties, more=True):
    return {
        "type": "object",
        "properties": properties,
        "required": sorted(properties),
        "additionalProperties": more,
    }


WHOLE = {"type": "integer", "minimum": 0}
ID = {"type": "integer", "minimum": 1}
TEXT = {"type": "string"}
RUNS = table({"size": {"type": "array", "items": ID, "minItems": 2, "maxItems": 2},
              "counts": {"type": "array", "items": WHOLE, "minItems": 2}}, False)
SCHEMA = table({
    "info": table({"description": TEXT, "version": TEXT}),
    "licenses": {"type": "array"},
    "images": {"type": "array", "minItems": 1,
               "items": table({"id": ID, "file_name": TEXT, "width": ID, "height": ID})},
    "annotations": {"type": "array", "minItems": 1, "items": table({
        "id": ID, "image_id": ID, "category_id": ID, "area": ID, "iscrowd": {"enum": [0]},
        "bbox": {"type": "array", "items": WHOLE, "minItems": 4, "maxItems": 4},
        "segmentation": RUNS})},
    "categories": {"type": "array", "minItems": 1, "items": table({"id": ID, "name": TEXT})},
})

with open(sys.argv[1], encoding="utf-8") as file:
    data = json.load(file)
jsonschema.validate(data, SCHEMA)
for key in ("images", "annotations", "categories"):
    ids = [entry["id"] for entry in data[key]]
    assert len(ids) == len(set(ids)), f"ids of {key} are not unique"
images = {entry["id"]: entry for entry in data["images"]}
categories = {entry["id"] for entry in data["categories"]}
for one in data["annotations"]:
    image = images[one["image_id"]]
    assert one["category_id"] in categories
    x, y, width, height = one["bbox"]
    assert x + width <= image["width"] and y + height <= image["height"]
    assert one["segmentation"]["size"] == [image["height"], image["width"]]
    assert sum(one["segmentation"]["counts"]) == image["width"] * image["height"]
    assert sum(one["segmentation"]["counts"][1::2]) == one["area"]

try:
    import cv2
    import numpy
except ImportError:
    sys.exit(0)
folder = pathlib.Path(sys.argv[1]).parent
hidden = cut_off = 0
for image in images.values():
    picture = cv2.imread(str(folder / image["file_name"]))
    assert picture.shape == (image["height"], image["width"], 3)
    name = pathlib.Path(image["file_name"]).name
    mask = cv2.imread(str(folder / "instances" / name), cv2.IMREAD_UNCHANGED)
    assert mask.dtype == numpy.uint16
    for one in (a for a in data["annotations"] if a["image_id"] == image["id"]):
        pixels = (mask == one["instance_id"]).astype(numpy.uint8)
        assert list(cv2.boundingRect(pixels)) == one["bbox"]
        assert cv2.countNonZero(pixels) == one["area"]
        counts = one["segmentation"]["counts"]
        painted = numpy.repeat(numpy.arange(len(counts)) % 2, counts).reshape(image["width"], image["height"]).T
        assert (painted == pixels).all()
        hidden += cv2.connectedComponents(pixels, connectivity=8)[0] > 2  # in pieces, by what is before it
        x, y, width, height = one["bbox"]
        cut_off += x == 0 or y == 0 or x + width == image["width"] or y + height == image["height"]
print(f"OpenCV: {len(images)} images, {len(data['annotations'])} boxes, {cut_off} cut off, {hidden} in pieces")
