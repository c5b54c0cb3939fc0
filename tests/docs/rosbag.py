# SPDX-License-Identifier: BSD-3-Clause
"""Writes a bag of ROS 1 (format 2.0) with point clouds: what the recipe of docs/import.md needs."""
import struct

MD5 = '1158d486dd51d683ce2f1be655c3c181'  # of sensor_msgs/PointCloud2
DEFINITION = """Header header
uint32 height
uint32 width
PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
bool is_dense
"""
FLOAT32 = 7


def text(value):
    return struct.pack('<I', len(value)) + value.encode()


def fields(**values):
    out = b''
    for name, value in values.items():
        field = name.encode() + b'=' + (value.encode() if isinstance(value, str) else value)
        out += struct.pack('<I', len(field)) + field
    return out


def record(data=b'', **values):
    head = fields(**values)
    return struct.pack('<I', len(head)) + head + struct.pack('<I', len(data)) + data


def time(stamp):
    return struct.pack('<II', int(stamp), round(1e9 * (stamp - int(stamp))))


def cloud_message(number, stamp, frame, points):
    points = points.astype('<f4')
    out = struct.pack('<I', number) + time(stamp) + text(frame) + struct.pack('<III', 1, len(points), 3)
    for i, name in enumerate('xyz'):
        out += text(name) + struct.pack('<IBI', 4 * i, FLOAT32, 1)
    return out + struct.pack('<BII', 0, 12, points.nbytes) + struct.pack('<I', points.nbytes) + points.tobytes() + b'\x01'


def write(path, topic, frame, clouds):
    """@param clouds [(stamp in s, (N, 3) points in the frame)]"""
    number = struct.pack('<I', 0)
    connection = record(fields(topic=topic, type='sensor_msgs/PointCloud2', md5sum=MD5, message_definition=DEFINITION),
                        op=b'\x07', conn=number, topic=topic)
    chunk, index = connection, b''
    for i, (stamp, points) in enumerate(clouds):
        index += time(stamp) + struct.pack('<I', len(chunk))
        chunk += record(cloud_message(i, stamp, frame, points), op=b'\x02', conn=number, time=time(stamp))
    count = struct.pack('<I', len(clouds))
    body = record(chunk, op=b'\x05', compression='none', size=struct.pack('<I', len(chunk)))
    body += record(index, op=b'\x04', ver=struct.pack('<I', 1), conn=number, count=count)
    magic, size_of_head = b'#ROSBAG V2.0\n', 4096
    start = len(magic) + size_of_head

    def head(padding):
        return record(b' ' * padding, op=b'\x03', index_pos=struct.pack('<Q', start + len(body)), conn_count=struct.pack('<I', 1),
                      chunk_count=struct.pack('<I', 1))
    info = record(number + count, op=b'\x06', ver=struct.pack('<I', 1), chunk_pos=struct.pack('<Q', start), start_time=time(clouds[0][0]),
                  end_time=time(clouds[-1][0]), count=struct.pack('<I', 1))
    path.write_bytes(magic + head(size_of_head - len(head(0))) + body + connection + info)
