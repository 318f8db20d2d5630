#!/usr/bin/env python3
"""Residual statistics of mrcal's own Python tools on a pinhole problem, for residual_statistics_mrcal_test.cpp.

usage: residual_mrcal_reference.py OUT.json
Two synthetic pinhole cameras see 10 boards of 10x8 corners with noise of 0.15 px and some gross
mistakes. mrcal solves it and marks outliers by its rule; what its tools say of that solution is
written. So that every pass of the rule can be compared, the problem is also solved pass by pass, by
mrcal without its rule and with marks made here; the last marks must be those of mrcal itself. Needs Debian's python3-mrcal.
"""
import json
import sys

import mrcal
import numpy as np

COLUMNS, ROWS, SPACING, FRAMES = 10, 8, 0.03, 10
SIZE = np.array((1200, 900), dtype=np.int32)


def make_problem():
    """Observations with noise and mistakes, seeded near the truth."""
    rng = np.random.default_rng(5)
    models = [mrcal.cameramodel(intrinsics=("LENSMODEL_OPENCV4",
                                            np.array((1500., 1490., 600., 450., -.1, .05, 1e-3, -1e-3))),
                                imagersize=SIZE) for _ in range(2)]
    models[1].extrinsics_rt_fromref(np.array((0.01, -0.05, 0.02, -0.1, 0.01, 0.)))
    np.random.seed(3)
    q, board_Rt = mrcal.synthesize_board_observations(
        models, object_width_n=COLUMNS, object_height_n=ROWS, object_spacing=SPACING,
        calobject_warp=None, rt_ref_boardcenter=np.array((0., 0., 0., .05, 0., .6)),
        rt_ref_boardcenter__noiseradius=np.array((.4, .4, .5, .06, .06, .1)), Nframes=FRAMES)
    q = q + rng.normal(0, 0.15, q.shape)
    wrong = rng.choice(q[..., 0].size, 30, replace=False)
    size = np.where(np.arange(30) < 6, 20., 1.)[:, np.newaxis]  # the large ones hide the small
    q.reshape(-1, 2)[wrong] += size * rng.choice((-1, 1), (30, 2))
    observations = np.ones(q.shape[:-1] + (3,))
    observations[..., :2] = q
    observations = observations.reshape(-1, ROWS, COLUMNS, 3)
    indices = np.array([(f, c, c - 1) for f in range(FRAMES) for c in range(2)], dtype=np.int32)
    return dict(
        lensmodel="LENSMODEL_OPENCV4",
        intrinsics=np.array([m.intrinsics()[1] for m in models]) *
        (1 + 1e-4 * rng.normal(size=(2, 8))),
        imagersizes=np.array((SIZE, SIZE)),
        extrinsics_rt_fromref=models[1].extrinsics_rt_fromref()[np.newaxis, :].copy(),
        frames_rt_toref=np.array([mrcal.rt_from_Rt(Rt) for Rt in board_Rt]),
        points=None, observations_board=observations,
        indices_frame_camintrinsics_camextrinsics=indices,
        observations_point=None, indices_point_camintrinsics_camextrinsics=None,
        calibration_object_spacing=SPACING, calobject_warp=np.zeros(2),
        do_optimize_intrinsics_core=True, do_optimize_intrinsics_distortions=True,
        do_optimize_extrinsics=True, do_optimize_frames=True, do_optimize_calobject_warp=False,
        do_apply_regularization=False, do_apply_outlier_rejection=False, verbose=False)


def residuals(problem):
    shape = problem["observations_board"].shape[:-1] + (2,)
    x = mrcal.optimizer_callback(**problem, no_jacobian=True, no_factorization=True)[1]
    return x[:np.prod(shape)].reshape(shape)


def state_of(problem):
    weight = problem["observations_board"][..., 2]
    return dict(x_px=residuals(problem).ravel().tolist(),
                outlier=(weight <= 0).ravel().astype(int).tolist())


def gnuplot_histogram(x, width=0.02):
    """Bins as gnuplot makes them from what mrcal hands it: counts from the first bin on."""
    bins = np.floor(x / width + 0.5).astype(int)
    return int(bins.min()), np.bincount(bins - bins.min()).tolist()


def camera(problem, icam):
    """What mrcal's tools say of one camera."""
    model = mrcal.cameramodel(optimization_inputs=problem, icam_intrinsics=icam)
    mean, sd, count, _ = mrcal.calibration._report_regional_statistics(model)
    vectors = mrcal.show_residuals_vectorfield(model, return_plot_args=True,
                                               valid_intrinsics_region=False)[0][0]
    directions = mrcal.show_residuals_directions(model, return_plot_args=True,
                                                 valid_intrinsics_region=False)[0][0]
    tuples, options = mrcal.show_residuals_histogram(problem, icam, return_plot_args=True)
    first, counts = gnuplot_histogram(tuples[0][0])
    return dict(mean_px=mean.ravel().tolist(), sd_px=sd.ravel().tolist(),
                scalars=count.ravel().astype(int).tolist(), rows=mean.shape[0],
                columns=mean.shape[1], magnitude_px=np.array(vectors[4]).tolist(),
                direction_deg=np.array(directions[2]).tolist(),
                sigma_px=float(np.std(tuples[0][0])), first_bin=first, counts=counts,
                curve=gaussian_curve(options["equation_above"]))


def gaussian_curve(equation):
    """The curve that mrcal draws beside the histogram, at some places, from its own text."""
    text = (equation if isinstance(equation, str) else equation[0]).split(" title ")[0]
    places = [-0.3, -0.1, 0., 0.04, 0.2]
    scope = {"exp": np.exp, "sqrt": np.sqrt, "pi": np.pi}
    return [[x, float(eval(text, dict(scope, x=x)))] for x in places]


def solve_pass_by_pass(problem):
    """Residuals and marks at the start of every pass of the rule."""
    passes = []
    while True:
        mrcal.optimize(**problem)
        passes.append(state_of(problem))
        x = np.abs(residuals(problem))
        weight = problem["observations_board"][..., 2]
        sigma = np.sqrt(np.mean(x[weight > 0]**2))
        if np.max(x[weight > 0]) <= 5 * sigma:
            return passes
        weight[(weight > 0) & (np.max(x, axis=-1) > 4 * sigma)] = -1


def main():
    problem = make_problem()
    by_mrcal = make_problem()
    by_mrcal["do_apply_outlier_rejection"] = True
    stats = mrcal.optimize(**by_mrcal)

    passes = solve_pass_by_pass(problem)
    x = residuals(by_mrcal)
    inliers = by_mrcal["observations_board"][..., 2] > 0
    per_board = np.sum(inliers.reshape(len(x), -1), axis=-1)
    rms = np.sqrt(np.sum(x.reshape(len(x), -1)**2, axis=-1) / per_board)
    out = dict(
        columns=COLUMNS, rows=ROWS, width=int(SIZE[0]), height=int(SIZE[1]),
        frame=by_mrcal["indices_frame_camintrinsics_camextrinsics"][:, 0].tolist(),
        camera=by_mrcal["indices_frame_camintrinsics_camextrinsics"][:, 1].tolist(),
        observed_px=by_mrcal["observations_board"][..., :2].ravel().tolist(),
        passes=passes, last=state_of(by_mrcal),
        rms_reproj_error__pixels=float(stats["rms_reproj_error__pixels"]),
        outliers=int(stats["Noutliers"]),
        observed_pixel_uncertainty=float(np.std(mrcal.residuals_chessboard(by_mrcal).ravel())),
        worst_point_px=float(np.sqrt(np.max(np.sum(x**2, axis=-1)))),
        rms_per_board_px=rms.tolist(), worst_first=[int(i) for i in reversed(np.argsort(rms))],
        cameras=[camera(by_mrcal, 0), camera(by_mrcal, 1)])
    with open(sys.argv[1], "w") as file:
        json.dump(out, file)


main()
