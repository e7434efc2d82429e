#pragma once

#include <vector>

#include "render/image/picture.hpp"
#include "render/measure/measurement.hpp"
#include "render/tiles/render.hpp"

namespace sdlc::render {

/// A picture that others are held against, and what is known of its own noise. All numbers are
/// 32-bit floats in value, so that one that was written to a file and read back is the same; of
/// squares there are the roots, which floats hold at every scale that the picture has.
struct ReferencePicture {
  Picture picture{};
  std::vector<float> noise{};       ///< of each pixel: root of PixelSpread::squared_error
  std::vector<float> covariance{};  ///< of each pixel: root of PixelSpread::covariance
};

/// Of a render that kept its variance. Takes what it needs.
ReferencePicture reference_picture(RenderResult&& result);

/// The mean of all channels of all pixels.
double mean_radiance(const Picture& picture);

/// The relative error of this very picture a: its distance |a − t| from the true picture t, of
/// which the reference r is an estimate, independent of a. The sum over pixels of |a − r|² − v with
/// v the estimate of E|r − t|² has |a − t|² as its mean. Given a, its variance is that of
/// |r − t|² − v, which is tr Σ² / 6 a pixel as in ErrorEstimate, and 4 (a − t)ᵀ Σ/4 (a − t) with
/// the covariance Σ/4 of r, which is |a − t|² v times the part of the noise that goes along a − t:
/// taken to be that of two pictures of the same noise, tr Σ² / (tr Σ)², over the whole picture.
/// Unlike the spread of a picture's own samples this knows of what depth and precision do to it,
/// and of rare light, as far as the reference does. Infinite where the
/// reference is black and the picture is not.
Measured error_against(const Picture& picture, const ReferencePicture& reference);

/// The standard deviation of that error among pictures of other seeds: the sum over pixels of the
/// squared error q has a variance of at least Σ 2 q² / 3, as normal errors that the channels share
/// have, of which the measured q are the only sample.
double error_spread(const Picture& picture, const ReferencePicture& reference);

}  // namespace sdlc::render
