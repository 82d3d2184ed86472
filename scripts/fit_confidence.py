#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Fits the confidence of the forest relocaliser, and says how far it can be trusted where it was not fitted.

    fit_confidence.py EVIDENCE.csv... [--test EVIDENCE.csv...] [--ridge LAMBDA]

Takes what `relocalisation_benchmark trust --evidence FILE` writes. Logistic regression with an L2 penalty; maps count alike, whatever their
number of answers. Prints the expected calibration error [Naeini2015] of each map that was left out of the fit, that of the files named
with --test, and the weights for modules/relocalisation/src/pose/confidence.h. Needs numpy.
"""
import argparse
import csv

import numpy as np

NUM_BINS = 10
BEFORE_FEATURES = 6  # columns: map, kind, right, confidence and two errors


class Answers:
    """Answers of several maps: features (n x d), right (n), map and kind by name."""

    def __init__(self, paths):
        rows = []
        for path in paths:
            with open(path, newline="") as file:
                reader = csv.reader(file)
                self.names = next(reader)[BEFORE_FEATURES:]
                rows += list(reader)
        self.maps = np.array([row[0] for row in rows])
        self.kinds = np.array([row[1] for row in rows])
        self.right = np.array([float(row[2]) for row in rows])
        self.before = np.array([float(row[3]) for row in rows])
        self.features = np.array([[float(value) for value in row[BEFORE_FEATURES:]] for row in rows])


def fit(features, right, weights, ridge):
    """Intercept and slopes by Newton's method, on standardised features."""
    mean = np.average(features, axis=0, weights=weights)
    scale = np.sqrt(np.average((features - mean) ** 2, axis=0, weights=weights)) + 1e-9
    x = np.hstack([np.ones((len(features), 1)), (features - mean) / scale])
    penalty = np.diag([0.0] + [ridge] * features.shape[1])
    beta = np.zeros(x.shape[1])
    for _ in range(100):
        probability = 1.0 / (1.0 + np.exp(-np.clip(x @ beta, -30, 30)))
        gradient = x.T @ (weights * (right - probability)) - penalty @ beta
        hessian = (x * (weights * probability * (1 - probability))[:, None]).T @ x + penalty
        step = np.linalg.solve(hessian, gradient)
        beta += step
        if np.abs(step).max() < 1e-8:
            break
    slopes = beta[1:] / scale
    return beta[0] - slopes @ mean, slopes


def predict(model, features):
    return 1.0 / (1.0 + np.exp(-np.clip(model[0] + features @ model[1], -30, 30)))


def calibration_error(confidence, right):
    """Mean over ten bins of |mean confidence - share right|, weighted by their answers."""
    bins = np.minimum((confidence * NUM_BINS).astype(int), NUM_BINS - 1)
    error = 0.0
    for b in range(NUM_BINS):
        inside = bins == b
        if inside.any():
            error += inside.mean() * abs(confidence[inside].mean() - right[inside].mean())
    return error


def report(name, confidence, right, threshold):
    believed = confidence >= threshold
    wrong = int((believed & (right == 0)).sum())
    share = (believed & (right == 1)).sum() / max(1, right.sum())
    print(f"| {name} | {len(right)} | {int(right.sum())} | {100 * share:.1f} | {wrong} | {calibration_error(confidence, right):.3f} |")


HEAD = "| answers of | number | right | of these believed [%] | wrong and believed | ECE |\n|---|---:|---:|---:|---:|---:|"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("evidence", nargs="+")
    parser.add_argument("--test", nargs="+", default=[])
    parser.add_argument("--ridge", type=float, default=1.0)
    parser.add_argument("--threshold", type=float, default=0.9, help="from which an answer counts as believed")
    options = parser.parse_args()
    answers = Answers(options.evidence)
    maps, counts = np.unique(answers.maps, return_counts=True)
    weights = np.ones(len(answers.right))
    for name, count in zip(maps, counts):
        weights[answers.maps == name] = len(answers.right) / len(maps) / count

    print("Each map by a model that was fitted to the others:\n\n" + HEAD)
    confidence = np.zeros(len(answers.right))
    for name in maps:
        own = answers.maps == name
        model = fit(answers.features[~own], answers.right[~own], weights[~own], options.ridge)
        confidence[own] = predict(model, answers.features[own])
        report(name, confidence[own], answers.right[own], options.threshold)
    report("all", confidence, answers.right, options.threshold)
    print("\nBy kind:\n\n" + HEAD)
    for kind in np.unique(answers.kinds):
        own = answers.kinds == kind
        report(kind, confidence[own], answers.right[own], options.threshold)

    model = fit(answers.features, answers.right, weights, options.ridge)
    if options.test:
        test = Answers(options.test)
        print("\nMaps that were not fitted to:\n\n" + HEAD)
        confidence = predict(model, test.features)
        for name in np.unique(test.maps):
            own = test.maps == name
            report(name, confidence[own], test.right[own], options.threshold)
        report("all", confidence, test.right, options.threshold)
        report("all, as shipped", test.before, test.right, options.threshold)
        print("\nBy kind:\n\n" + HEAD)
        for kind in np.unique(test.kinds):
            own = test.kinds == kind
            report(kind, confidence[own], test.right[own], options.threshold)
    print("\nintercept", f"{model[0]:.3f}")
    for name, slope in zip(answers.names, model[1]):
        print(f"{name:>20} {slope:9.3f}")


if __name__ == "__main__":
    main()
