# SPDX-License-Identifier: MIT
"""PNG files with 8-bit RGB or RGBA pixels, read and written without a library."""
import struct
import zlib
from dataclasses import dataclass

SIGNATURE = b"\x89PNG\r\n\x1a\n"


@dataclass
class Picture:
    width: int
    height: int
    rows: list  # bytes of RGB, top row first

    def pixel(self, x, y):
        return tuple(self.rows[y][3 * x:3 * x + 3])


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def encode(picture):
    header = struct.pack(">IIBBBBB", picture.width, picture.height, 8, 2, 0, 0, 0)
    rows = b"".join(b"\0" + bytes(row) for row in picture.rows)
    return (SIGNATURE + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows))
            + chunk(b"IEND", b""))


def chunks(data):
    if not data.startswith(SIGNATURE):
        raise ValueError("not a PNG file")
    at = len(SIGNATURE)
    while at < len(data):
        [length] = struct.unpack_from(">I", data, at)
        yield data[at + 4:at + 8], data[at + 8:at + 8 + length]
        at += length + 12


def paeth(left, up, corner):
    guess = left + up - corner
    distances = abs(guess - left), abs(guess - up), abs(guess - corner)
    return (left, up, corner)[distances.index(min(distances))]


PREDICT = [lambda left, up, corner: 0, lambda left, up, corner: left, lambda left, up, corner: up,
           lambda left, up, corner: (left + up) // 2, paeth]


def unfilter(method, row, above, step):
    if method == 0:
        return row
    if method == 2:
        return bytearray((x + up) & 255 for x, up in zip(row, above))
    predict = PREDICT[method]
    for i in range(len(row)):
        left, corner = (row[i - step], above[i - step]) if i >= step else (0, 0)
        row[i] = (row[i] + predict(left, above[i], corner)) & 255
    return row


def decode(data):
    """Drops the alpha of RGBA."""
    parts = list(chunks(data))
    width, height, depth, kind, *_, interlaced = struct.unpack(">IIBBBBB", dict(parts)[b"IHDR"])
    if depth != 8 or kind not in (2, 6) or interlaced:
        raise ValueError("not 8-bit RGB or RGBA without interlacing")
    step = {2: 3, 6: 4}[kind]
    packed = zlib.decompress(b"".join(body for name, body in parts if name == b"IDAT"))
    rows, above, stride = [], bytearray(width * step), width * step + 1
    for y in range(height):
        row = bytearray(packed[y * stride + 1:(y + 1) * stride])
        above = unfilter(packed[y * stride], row, above, step)
        rows.append(bytes(above))
    if step == 4:
        rows = [bytes(v for i, v in enumerate(row) if i % 4 != 3) for row in rows]
    return Picture(width, height, rows)
