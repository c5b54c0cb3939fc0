# SPDX-License-Identifier: BSD-3-Clause
"""Opens a .3Dscene in MRPT's SceneViewer3D on a virtual display, and waits until pixels in the colour of tables show.
Exit code 0: seen; 1: not seen in 40 s; 77: a program is missing."""
import os, shutil, struct, subprocess, sys, tempfile, time

if not shutil.which('Xvfb') or not shutil.which('SceneViewer3D'):
    sys.exit(77)


def magenta_pixels(dump):
    """Of an XWD file: its header is big-endian words, its pixels are blue, green, red, unused."""
    data = open(dump, 'rb').read()
    header, colours = struct.unpack('>I', data[:4])[0], struct.unpack('>I', data[76:80])[0]
    pixels = data[header + 12 * colours:]
    return sum(red > green + 60 and blue > green + 40 for blue, green, red in zip(pixels[0::4], pixels[1::4], pixels[2::4]))


with tempfile.TemporaryDirectory() as folder:
    read, write = os.pipe()
    screen = subprocess.Popen(['Xvfb', '-displayfd', str(write), '-screen', '0', '800x600x24', '-fbdir', folder],
                              pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    display = os.read(read, 20).decode().strip()
    viewer = subprocess.Popen(['SceneViewer3D', sys.argv[1]], env={**os.environ, 'DISPLAY': ':' + display, 'HOME': folder},
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    seen = 0
    try:
        end = time.monotonic() + 40
        while seen < 20 and time.monotonic() < end and viewer.poll() is None:
            time.sleep(0.3)
            seen = magenta_pixels(os.path.join(folder, 'Xvfb_screen0'))
    finally:
        viewer.kill()
        viewer.wait()
        screen.terminate()
        screen.wait()
    print(seen, 'pixels in the colour of tables')
    sys.exit(0 if seen >= 20 else 1)
