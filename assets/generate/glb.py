"""Writes glTF 2.0 binary files (.glb): meshes, materials, embedded pictures. Needs numpy, Pillow."""

import io
import json
import struct

import numpy as np
from PIL import Image


class Glb:
    def __init__(self, generator):
        self.bin = bytearray()
        self.json = {
            "asset": {"version": "2.0", "generator": generator},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "materials": [],
            "accessors": [],
            "bufferViews": [],
            "buffers": [],
        }

    def _view(self, data, target=None):
        self.bin += b"\0" * (-len(self.bin) % 4)
        view = {"buffer": 0, "byteOffset": len(self.bin), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.bin += data
        self.json["bufferViews"].append(view)
        return len(self.json["bufferViews"]) - 1

    def _accessor(self, array, kind, component, target, bounds=False):
        accessor = {
            "bufferView": self._view(array.tobytes(), target),
            "componentType": component,
            "count": len(array),
            "type": kind,
        }
        if bounds:
            accessor["min"] = array.min(axis=0).tolist()
            accessor["max"] = array.max(axis=0).tolist()
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def texture(self, pixels, name, quality=92):
        """`pixels`: height x width x 3 (or 4), 0..1, already encoded (sRGB for colours). JPEG; PNG with alpha."""
        data = np.clip(pixels * 255.0 + 0.5, 0, 255).astype(np.uint8)
        out = io.BytesIO()
        if data.shape[2] == 4:
            Image.fromarray(data, "RGBA").save(out, "PNG", optimize=True)
            mime = "image/png"
        else:
            Image.fromarray(data, "RGB").save(out, "JPEG", quality=quality, subsampling=0, optimize=True)
            mime = "image/jpeg"
        if "samplers" not in self.json:
            self.json["samplers"] = [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 33071}]
        self.json.setdefault("images", []).append(
            {"bufferView": self._view(out.getvalue()), "mimeType": mime, "name": name}
        )
        self.json.setdefault("textures", []).append({"sampler": 0, "source": len(self.json["images"]) - 1})
        return len(self.json["textures"]) - 1

    def material(
        self, name, color=(1, 1, 1, 1), metallic=0.0, roughness=1.0, base=None, normal=None, surface=None, **more
    ):
        """`base`, `normal`, `surface` (metallic-roughness): textures. `more`: further glTF material members."""
        pbr = {"baseColorFactor": list(color), "metallicFactor": metallic, "roughnessFactor": roughness}
        if base is not None:
            pbr["baseColorTexture"] = {"index": base}
        if surface is not None:
            pbr["metallicRoughnessTexture"] = {"index": surface}
        material = {"name": name, "pbrMetallicRoughness": pbr, **more}
        if normal is not None:
            material["normalTexture"] = {"index": normal}
        self.json["materials"].append(material)
        return len(self.json["materials"]) - 1

    def primitive(self, surface, material):
        attributes = {
            "POSITION": self._accessor(surface.positions.astype("<f4"), "VEC3", 5126, 34962, bounds=True),
            "NORMAL": self._accessor(surface.normals.astype("<f4"), "VEC3", 5126, 34962),
        }
        if surface.tangents is not None:
            attributes["TANGENT"] = self._accessor(surface.tangents.astype("<f4"), "VEC4", 5126, 34962)
        if surface.uvs is not None:
            attributes["TEXCOORD_0"] = self._accessor(surface.uvs.astype("<f4"), "VEC2", 5126, 34962)
        small = len(surface.positions) <= 65535
        indices = surface.triangles.reshape(-1).astype("<u2" if small else "<u4")
        return {
            "attributes": attributes,
            "indices": self._accessor(indices, "SCALAR", 5123 if small else 5125, 34963),
            "material": material,
        }

    def mesh(self, name, primitives):
        self.json["meshes"].append({"name": name, "primitives": primitives})
        return len(self.json["meshes"]) - 1

    def node(self, name, mesh, **transform):
        self.json["nodes"].append({"name": name, "mesh": mesh, **transform})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def write(self, path):
        self.json["buffers"] = [{"byteLength": len(self.bin)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        body = bytes(self.bin) + b"\0" * (-len(self.bin) % 4)
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(path, "wb") as f:
            f.write(struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(body)))
            f.write(struct.pack("<I4s", len(text), b"JSON") + text)
            f.write(struct.pack("<I4s", len(body), b"BIN\0") + body)
        triangles = sum(a["count"] for a in self.json["accessors"] if a["type"] == "SCALAR") // 3
        print(f"{path.name}: {triangles} triangles, {path.stat().st_size / 1e6:.2f} MB")
