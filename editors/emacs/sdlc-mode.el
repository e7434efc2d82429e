;;; sdlc-mode.el --- Scenes of the renderer sdlc  -*- lexical-binding: t -*-

;; Package-Requires: ((emacs "27.1"))
;; SPDX-License-Identifier: Apache-2.0

;;; Commentary:

;; A major mode for .scene files: comments, strings, keywords and indentation.  Everything else comes from the
;; language server `sdlc lsp', through Eglot:
;;
;;   (require 'sdlc-mode)
;;   (add-hook 'sdlc-mode-hook #'eglot-ensure)

;;; Code:

(defgroup sdlc nil
  "Scenes of the renderer sdlc."
  :group 'languages)

(defcustom sdlc-program "sdlc"
  "The program `sdlc': a name on the PATH, or a file."
  :type 'string)

(defcustom sdlc-indent 2
  "Columns of a level of indentation; `sdlc fmt' uses 2."
  :type 'integer)

(defvar sdlc-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?/ ". 124b" table)
    (modify-syntax-entry ?* ". 23n" table)
    (modify-syntax-entry ?\n "> b" table)
    (modify-syntax-entry ?_ "_" table)
    (modify-syntax-entry ?# "." table)
    table))

(defvar sdlc-font-lock-keywords
  (list
   ;; The reserved words of grammar/scene.ebnf, with `scene' and `as', which are words only here.
   (cons (concat "\\_<" (regexp-opt '("and" "as" "assert" "def" "else" "fn" "for" "if" "import" "in" "include" "let"
                                      "not" "or" "param" "scene" "then"))
                 "\\_>")
         font-lock-keyword-face)
   (cons "\\_<\\(?:true\\|false\\)\\_>" font-lock-constant-face)
   '("\\_<\\(?:let\\|param\\)[ \t]+\\([[:alpha:]_][[:alnum:]_]*\\)" 1 font-lock-variable-name-face)
   '("\\_<fn[ \t]+\\([[:alpha:]_][[:alnum:]_]*\\)" 1 font-lock-function-name-face)
   '("\\_<def[ \t]+\\([[:alpha:]_][[:alnum:]_]*\\)" 1 font-lock-type-face)
   '("^[ \t]*\\([[:alpha:]_][[:alnum:]_.]*\\)\\(?:[ \t]+[[:alpha:]_][[:alnum:]_]*\\)?[ \t]*{" 1 font-lock-type-face)
   '("\\_<\\([[:alpha:]_][[:alnum:]_]*\\):" 1 font-lock-builtin-face)
   '("#[[:xdigit:]]+\\_>" . font-lock-constant-face))
  "What the mode colours by itself.")

(defun sdlc-indent-line ()
  "Indent the line by the number of brackets that are open before it."
  (interactive)
  (let* ((depth (save-excursion
                  (back-to-indentation)
                  (let ((open (car (syntax-ppss))))
                    (if (looking-at "[]})]") (1- open) open))))
         (column (* sdlc-indent (max 0 depth))))
    (if (<= (current-column) (current-indentation))
        (indent-line-to column)
      (save-excursion (indent-line-to column)))))

;;;###autoload
(define-derived-mode sdlc-mode prog-mode "Scene"
  "Major mode for scenes of the renderer sdlc."
  (setq-local comment-start "// "
              comment-end ""
              comment-start-skip "\\(?://+\\|/\\*+\\)[ \t]*"
              indent-line-function #'sdlc-indent-line
              indent-tabs-mode nil
              tab-width sdlc-indent
              font-lock-defaults '(sdlc-font-lock-keywords)))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.scene\\'" . sdlc-mode))

(defvar eglot-server-programs)
(declare-function eglot-initialization-options "eglot")
(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs
               (cons '(sdlc-mode :language-id "scene") (lambda (&rest _) (list sdlc-program "lsp")))))

(provide 'sdlc-mode)
;;; sdlc-mode.el ends here
