"""Holds every measure of `sdlc compare` against one of its own, written with numpy from the definitions.

Usage: check_compare.py SDLC FOLDER. Writes pictures into FOLDER with OpenImageIO, runs the program on them,
and prints the largest disagreement of each measure; exits with 1 where one is too large.
"""

import json
import math
import os
import subprocess
import sys

import numpy as np
import OpenImageIO as oiio

SDLC, FOLDER = sys.argv[1:3]


# --- FLIP, as in the paper: filters in two dimensions, and the constants of its supplement ---

RGB_TO_XYZ = np.array([[0.4123907993, 0.3575843394, 0.1804807884],
                       [0.2126390059, 0.7151686788, 0.0721923154],
                       [0.0193308187, 0.1191947798, 0.9505321522]])
WHITE = RGB_TO_XYZ @ np.ones(3)


def to_xyz(rgb):
    return rgb @ RGB_TO_XYZ.T / WHITE


def to_ycxcz(rgb):
    x, y, z = np.moveaxis(to_xyz(rgb), -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], -1)


def from_ycxcz(color):
    y = (color[..., 0] + 16) / 116
    xyz = np.stack([y + color[..., 1] / 500, y, y - color[..., 2] / 200], -1)
    return (xyz * WHITE) @ np.linalg.inv(RGB_TO_XYZ).T


def to_hunt_lab(rgb):
    t = to_xyz(rgb)
    f = np.where(t > (6 / 29) ** 3, np.cbrt(t), t * (29 / 6) ** 2 / 3 + 4 / 29)
    lightness = 116 * f[..., 1] - 16
    a = 500 * (f[..., 0] - f[..., 1])
    b = 200 * (f[..., 1] - f[..., 2])
    return np.stack([lightness, a * lightness / 100, b * lightness / 100], -1)


def hyab(p, q):
    d = p - q
    return np.abs(d[..., 0]) + np.hypot(d[..., 1], d[..., 2])


def convolve(plane, kernel):
    """Correlation with a square kernel; the border repeats."""
    radius = kernel.shape[0] // 2
    padded = np.pad(plane, radius, mode="edge")
    height, width = plane.shape
    result = np.zeros_like(plane)
    for dy in range(kernel.shape[0]):
        for dx in range(kernel.shape[1]):
            result += kernel[dy, dx] * padded[dy:dy + height, dx:dx + width]
    return result


def grid(radius):
    axis = np.arange(-radius, radius + 1, dtype=float)
    return np.meshgrid(axis, axis)


def contrast_kernel(terms, ppd):
    radius = math.ceil(3 * math.sqrt(0.04 / (2 * math.pi**2)) * ppd)
    x, y = grid(radius)
    squares = (x**2 + y**2) / ppd**2
    kernel = sum(a * math.sqrt(math.pi / b) * np.exp(-math.pi**2 * squares / b) for a, b in terms)
    return kernel / kernel.sum()


def feature_kernel(kind, ppd):
    deviation = 0.5 * 0.082 * ppd
    x, y = grid(math.ceil(3 * deviation))
    bell = np.exp(-(x**2 + y**2) / (2 * deviation**2))
    kernel = -x * bell if kind == "edge" else (x**2 / deviation**2 - 1) * bell
    positive = kernel[kernel > 0].sum()
    negative = -kernel[kernel < 0].sum()
    return np.where(kernel > 0, kernel / positive, kernel / negative)


def features(luminance, kind, ppd):
    kernel = feature_kernel(kind, ppd)
    return np.hypot(convolve(luminance, kernel), convolve(luminance, kernel.T))


def flip(picture, reference, ppd):
    seen, luminances = [], []
    for rgb in (picture, reference):
        color = to_ycxcz(np.clip(rgb, 0, 1))
        luminances.append((color[..., 0] + 16) / 116)
        filtered = np.stack([
            convolve(color[..., 0], contrast_kernel([(1, 0.0047)], ppd)),
            convolve(color[..., 1], contrast_kernel([(1, 0.0053)], ppd)),
            convolve(color[..., 2], contrast_kernel([(34.1, 0.04), (13.5, 0.025)], ppd))], -1)
        seen.append(to_hunt_lab(np.clip(from_ycxcz(filtered), 0, 1)))
    error = hyab(*seen) ** 0.7
    largest = float(hyab(to_hunt_lab(np.array([0.0, 1, 0])), to_hunt_lab(np.array([0.0, 0, 1])))) ** 0.7
    knee = 0.4 * largest
    error = np.where(error < knee, 0.95 / knee * error, 0.95 + 0.05 * (error - knee) / (largest - knee))
    differences = [np.abs(features(luminances[0], kind, ppd) - features(luminances[1], kind, ppd))
                   for kind in ("edge", "point")]
    feature = (np.maximum(*differences) / math.sqrt(2)) ** 0.5
    return float(np.mean(error ** (1 - feature)))


# --- The other measures ---


def measure(a, b):
    d = a - b
    rmse = math.sqrt(np.mean(d**2))
    relative = np.mean(d**2 / (b**2 + 0.01), axis=2).ravel()
    kept = np.sort(relative)[:relative.size - relative.size // 100]
    y, x, channel = np.unravel_index(np.argmax(np.abs(d)), d.shape)
    return {"rmse": rmse, "relative_error": rmse / b.mean(), "relative_mse": relative.mean(),
            "relative_mse_trimmed": kept.mean(), "psnr": 10 * math.log10(1 / np.mean(d**2)),
            "max_difference": {"value": float(d[y, x, channel]), "x": int(x), "y": int(y),
                               "channel": ("red", "green", "blue")[channel]}}


def z_test(a, b, va, vb):
    d, v = a - b, va + vb
    z = d.sum(axis=(0, 1)) / np.sqrt(v.sum(axis=(0, 1)))
    excess = (d**2 - v).sum(axis=2)
    noise_z = excess.sum() / math.sqrt((excess**2).sum())
    return {"mean_z": z.tolist(), "mean_p": min(1, 3 * math.erfc(np.abs(z).max() / math.sqrt(2))),
            "noise_z": noise_z, "noise_p": math.erfc(noise_z / math.sqrt(2)) / 2}


# --- Pictures ---


def write(name, values, kind, channels=("R", "G", "B"), tone=None):
    spec = oiio.ImageSpec(values.shape[1], values.shape[0], values.shape[2], kind)
    spec.channelnames = channels
    if tone:
        spec.attribute("sdlc:tone", tone)
    path = os.path.join(FOLDER, name)
    output = oiio.ImageOutput.create(path)
    assert output.open(path, spec), output.geterror()
    assert output.write_image(np.ascontiguousarray(values)), output.geterror()
    output.close()
    return path


def scene(random, height, width):
    """Edges, a ramp, dark and bright places, colours."""
    y, x = np.mgrid[0:height, 0:width]
    picture = np.stack([x / width, y / height, 0.5 + 0.5 * np.sin(x / 3.0)], -1)
    picture[(x - width / 2) ** 2 + (y - height / 2) ** 2 < (height / 4) ** 2] = (0.8, 0.1, 0.05)
    picture[: height // 5] *= 0.02
    return picture * (1 + 0.3 * random.random())


worst = {}


def agree(name, mine, its, tolerance):
    """Relative to what is expected; of values below 1e-3, to that."""
    error = abs(mine - its) / max(abs(mine), 1e-3)
    worst[name] = max(worst.get(name, 0), error)
    if not error <= tolerance:
        print(f"{name}: {its} of sdlc compare, {mine} of numpy")
        sys.exit(1)


def check(a, b, ppd, picture, reference, linear_picture, linear_reference, variances=None):
    """`picture` and `reference` are the values as compared, of the files a and b."""
    command = [SDLC, "compare", a, b, "--format", "json", "--pixels-per-degree", str(ppd)]
    its = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    mine = measure(picture, reference)
    for name in ("rmse", "relative_error", "relative_mse", "relative_mse_trimmed", "psnr"):
        agree(name, mine[name], its[name], 1e-9)
    for name in ("x", "y", "channel"):
        assert mine["max_difference"][name] == its["max_difference"][name], (mine, its)
    agree("max_difference", mine["max_difference"]["value"], its["max_difference"]["value"], 1e-9)
    # The matrices of the two are rounded differently, in the fifth digit of a colour.
    agree("flip", flip(linear_picture, linear_reference, ppd), its["flip"], 2e-4)
    if variances is None:
        assert its["z_test"] is None
        return
    test = z_test(picture, reference, *variances)
    for name in ("mean_p", "noise_z", "noise_p"):
        agree(name, test[name], its["z_test"][name], 1e-9)
    for mine_z, its_z in zip(test["mean_z"], its["z_test"]["mean_z"]):
        agree("mean_z", mine_z, its_z, 1e-9)


def check_linear(random, height, width, ppd):
    reference = scene(random, height, width).astype(np.float32)
    variances = [(0.001 + 0.01 * random.random(reference.shape)).astype(np.float32) for _ in range(2)]
    picture = (reference + 0.05 * random.standard_normal(reference.shape)).astype(np.float32)
    channels = ("R", "G", "B", "variance.R", "variance.G", "variance.B")
    names = [write(f"{name}.exr", np.concatenate([values, variance], axis=2), oiio.FLOAT, channels)
             for name, values, variance in zip("ab", (picture, reference), variances)]
    picture, reference = picture.astype(float), reference.astype(float)
    check(*names, ppd, picture, reference, picture, reference, [v.astype(float) for v in variances])


def decode(codes, tone):
    if tone == "sqrt":
        return codes**2
    if tone == "linear":
        return codes
    return np.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4)


def check_codes(random, height, width, ppd, kind, white, tone):
    reference = np.clip(scene(random, height, width), 0, 1)
    picture = np.clip(np.roll(reference, 1, axis=1) + 0.02 * random.standard_normal(reference.shape), 0, 1)
    codes = [np.round(white * values).astype(np.uint8 if white == 255 else np.uint16)
             for values in (picture, reference)]
    names = [write(f"{name}.png", values, kind, tone=tone) for name, values in zip("ab", codes)]
    picture, reference = (values / white for values in codes)
    check(*names, ppd, picture, reference, decode(picture, tone), decode(reference, tone))


generator = np.random.default_rng(20)
check_linear(generator, 90, 130, 67.0206)
check_linear(generator, 40, 31, 30)
check_linear(generator, 7, 5, 100)
check_codes(generator, 70, 90, 67.0206, oiio.UINT8, 255, None)
check_codes(generator, 45, 64, 20, oiio.UINT8, 255, "sqrt")
check_codes(generator, 45, 64, 67.0206, oiio.UINT8, 255, "linear")
check_codes(generator, 45, 64, 67.0206, oiio.UINT16, 65535, "srgb")
for measured, difference in worst.items():
    print(f"{measured}: {difference:.2g}")
