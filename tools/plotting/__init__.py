# SPDX-License-Identifier: GPL-3.0-or-later
"""What tools/plot.py draws: readers, numbers and pictures of result folders.

    reading   result folders and tables        numbers   lines across plies, folds, ratios
    looks     colours, labels, line styles     draw_*    a picture each, from the command's options
"""
