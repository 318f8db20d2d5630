#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/gray_image.h"
#include "session/session.h"

namespace telestrain::correlation {

// The pixels of a region. A region outside the image or below 8 px a side is a broken contract.
GrayImage Crop(const GrayImage& image, const PixelRegion& region);

// Normalised samples of a Gaussian, 2n+1 of them; {1} when sigma is zero or less.
std::vector<float> GaussianKernel(double sigma_px);

// out(x) = sum_k kernel[k] in(x + k - n) along the rows or the columns, the border mirrored about
// the outermost pixel centres.
GrayImage FilterRows(const GrayImage& image, const std::vector<float>& kernel);
GrayImage FilterColumns(const GrayImage& image, const std::vector<float>& kernel);

// Both directions with the same kernel.
GrayImage Blur(const GrayImage& image, const std::vector<float>& kernel);

// Variance of white noise of variance one after a filter: the sum of the squared weights.
double NoiseVarianceAfter(const std::vector<float>& weights);

// A kernel that is not a product of two: (2 reach + 1)^2 weights, row by row.
struct PlaneKernel {
  int reach = 0;
  std::vector<float> weights{1.f};
};

// Gaussian whose samples have the given second moments (px^2), also where it is narrower than a
// pixel.
PlaneKernel GaussianPlaneKernel(const Eigen::Matrix2d& covariance_px2);
GrayImage FilterPlane(const GrayImage& image, const PlaneKernel& kernel);

}  // namespace telestrain::correlation
