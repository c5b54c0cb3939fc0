# SPDX-License-Identifier: BSD-3-Clause
"""Small inputs by the names that the documents give to the reader's own data: a table with a box, ray-cast."""
import numpy as np
from PIL import Image

import rosbag

WIDTH, HEIGHT, F = 160, 120, 150.0
BOXES = [((-0.7, -0.5, 0.72), (0.7, 0.5, 0.75)), ((-0.05, -0.05, 0.75), (0.15, 0.1, 0.9)), ((-3, -3, -0.1), (3, 3, 0.0))]


def world_from_camera(k):
    """Optical frame (z forward, y down) of frame k: looks down on the table, moving along it."""
    eye = np.array([-0.3 + 0.1 * k, -1.1, 1.45])
    forward = np.array([0.0, 0.1, 0.75]) - eye
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0, 0, 1.0])
    right /= np.linalg.norm(right)
    pose = np.eye(4)
    pose[:3, :3] = np.column_stack([right, np.cross(forward, right), forward])
    pose[:3, 3] = eye
    return pose


def look(pose, scale=1, f=F):
    """Of `scale` times WIDTH x HEIGHT pixels, with focal length f (pixels): metres along the optical axis, 0: nothing; number of the box that is seen."""
    u, v = np.meshgrid(np.arange(scale * WIDTH), np.arange(scale * HEIGHT))
    rays = np.stack([(u - scale * WIDTH / 2) / f, (v - scale * HEIGHT / 2) / f, np.ones_like(u, float)], -1) @ pose[:3, :3].T
    depth, seen = np.full(u.shape, np.inf), np.zeros(u.shape, np.uint8)
    for i, (low, high) in enumerate(BOXES):
        with np.errstate(divide='ignore', invalid='ignore'):
            a, b = (low - pose[:3, 3]) / rays, (high - pose[:3, 3]) / rays
        near, far = np.minimum(a, b).max(-1), np.maximum(a, b).min(-1)
        hit = (near < far) & (near > 0) & (near < depth)
        depth[hit], seen[hit] = near[hit], i
    return np.where(np.isfinite(depth), depth, 0.0), seen


def depth_image(pose, scale=1, f=F):
    return look(pose, scale, f)[0]


def quaternion(r):
    w = np.sqrt(max(0.0, 1 + np.trace(r))) / 2
    return np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]) / (4 * w), w


def tum_row(stamp, pose):
    (x, y, z), w = quaternion(pose[:3, :3])
    return f'{stamp:.4f} ' + ' '.join(f'{value:.9f}' for value in [*pose[:3, 3], x, y, z, w]) + '\n'


def make(folder, frames=4):
    tum, seq, clouds = folder / 'rgbd_dataset_freiburg1_desk', folder / 'seq-01', folder / 'clouds'
    kitti, kitti_poses = folder / 'sequences/00/velodyne', ''
    for path in (tum / 'depth', seq, clouds, kitti, folder / 'poses'):
        path.mkdir(parents=True)
    listing, poses, bag = '# timestamp filename\n', '', []
    for k in range(frames):
        pose, stamp = world_from_camera(k), 100.0 + 0.1 * k
        depth = depth_image(pose)
        Image.fromarray((5000 * depth).astype(np.uint16)).save(tum / f'depth/{k}.png')
        listing += f'{stamp:.4f} depth/{k}.png\n'
        poses += tum_row(stamp, pose)
        Image.fromarray((1000 * depth_image(pose, 4, 585.0)).astype(np.uint16)).save(seq / f'frame-{k:06}.depth.png')
        np.savetxt(seq / f'frame-{k:06}.pose.txt', pose)
        v, u = np.nonzero(depth)
        z = depth[v, u]
        points = np.column_stack([(u - WIDTH / 2) / F * z, (v - HEIGHT / 2) / F * z, z])
        bag.append((stamp, points))
        header = (f'VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {len(points)}\nHEIGHT 1\n'
                  f'VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA ascii\n')
        with open(clouds / f'{stamp:.6f}.pcd', 'w') as file:
            file.write(header)
            np.savetxt(file, points, fmt='%.5f')
        np.column_stack([points, np.zeros(len(points))]).astype(np.float32).tofile(kitti / f'{k:06}.bin')
        kitti_poses += ' '.join(f'{value:.9f}' for value in pose[:3].ravel()) + '\n'
    (tum / 'depth.txt').write_text(listing)
    (tum / 'groundtruth.txt').write_text(poses)
    (tum / 'camera.txt').write_text(f'{F} {F} {WIDTH / 2} {HEIGHT / 2} {WIDTH} {HEIGHT} 5000\n')
    (folder / 'poses/00.txt').write_text(kitti_poses)
    (kitti.parent / 'calib.txt').write_text('Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n')
    (folder / 'trajectory.txt').write_text(poses)
    rosbag.write(folder / 'office.bag', '/camera/depth_registered/points', 'camera', bag)
    for name, text in (('vi-a/vi_a.csv', 'set,resolution_mm,method,seconds\ntable,8,hierarchy,1\ntable,4,hierarchy,2\n'),
                       ('vi-b/vi_b.csv', 'sequence,scans,ghosts_monolithic\nocclusion,12,300\n')):
        path = folder / 'out' / name
        path.parent.mkdir(parents=True)
        path.write_text(text)


def make_shared(folder, hoctomap):
    """Stands for the real data beside a clone: a log, a sequence, a labelled scene. @param hoctomap runs the program"""
    log, sequence, scene = folder / 'redkitchen/table_sweep_a.rawlog', folder / 'mosd_change/occl_00/sequence.rawlog', folder / 'mosd/000001'
    for path in (log.parent, sequence.parent, scene):
        path.mkdir(parents=True)
    hoctomap('simulate', '-q', '-c', 'configs/scenes/demo.ini', '-o', str(log))
    hoctomap('simulate', '-q', '-c', 'configs/scenes/occlusion.ini', '-o', str(sequence), '--set', 'camera.width=160', '--set', 'camera.height=120',
             '--set', 'camera.fx=135')
    frames = folder / 'frames'
    frames.mkdir()
    pose = world_from_camera(2)
    depth, seen = look(pose)
    Image.fromarray((1000 * depth).astype(np.uint16)).save(frames / 'frame-000000.depth.png')
    np.savetxt(frames / 'frame-000000.pose.txt', pose)
    hoctomap('import', 'frames', str(frames), '--intrinsics', f'{F},{F},{WIDTH / 2},{HEIGHT / 2}', '-o', str(scene / 'scene.rawlog'))
    label = np.array([1, 20, 2], np.uint8)[seen]  # table, object, background
    Image.fromarray(np.where(depth > 0, label, 0).astype(np.uint8)).save(scene / 'label.png')
