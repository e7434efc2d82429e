#pragma once

#include <vector>

#include "render/image/picture.hpp"
#include "render/measure/measurement.hpp"
#include "render/session/render.hpp"

namespace sdlc::render {

/// The picture that others are compared with, and estimates of its noise. All numbers have 32-bit
/// float precision, so a picture read back from a file is identical. Squares are stored as their
/// roots, which floats can hold at any scale of the picture.
struct ReferencePicture {
  Picture picture{};
  std::vector<float> noise{};       ///< per pixel: root of PixelSpread::squared_error
  std::vector<float> covariance{};  ///< per pixel: root of PixelSpread::covariance
};

/// From a render that kept its variance. Moves what it needs out of `result`.
ReferencePicture reference_picture(RenderResult&& result);

/// The mean over all channels and pixels.
double mean_radiance(const Picture& picture);

/// The relative error of this very picture.
///
/// Let a be the picture, t the true picture, and r the reference, an estimate of t that is
/// independent of a. The sum over pixels of |a − r|² − v, where v is the estimate of E|r − t|², has
/// the expectation |a − t|². Given a, its variance has two parts per pixel: that of |r − t|² − v,
/// which is tr Σ² / 6 as in ErrorEstimate, and 4 (a − t)ᵀ Σ/4 (a − t), where Σ/4 is the covariance
/// of r. The second part is |a − t|² v times the share of the noise along a − t. That share is
/// assumed to be the one for two pictures with the same noise, tr Σ² / (tr Σ)² over the whole
/// picture.
///
/// Unlike the spread of a picture's own samples, this error includes the bias of depth and
/// precision, and rare light as far as the reference has it. Infinite if the reference is black and
/// the picture is not.
Measured error_against(const Picture& picture, const ReferencePicture& reference);

/// The standard deviation of that error over seeds. The sum over pixels of the squared error q has
/// a variance of at least Σ 2 q² / 3, the value for normal errors shared by the channels; the
/// measured q are the only sample.
double error_spread(const Picture& picture, const ReferencePicture& reference);

}  // namespace sdlc::render
